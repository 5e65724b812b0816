"""`python -m crew`: the command line."""

from crew.cli.main import main

main()
