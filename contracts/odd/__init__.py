"""What is legal in a contract but odd: said as warnings, never as refusals. Pure."""
