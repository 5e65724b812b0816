"""A run as one HTML page for people: no scripts, nothing from elsewhere, everything escaped."""
