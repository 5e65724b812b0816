"""Why something was decided as it was, and what would have been decided otherwise. Pure; decides with the real gate."""
