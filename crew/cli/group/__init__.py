"""The commands, a file for each group of them. Each command imports what it needs when it runs."""
