"""``python -m cdcr``: the command line."""

from cdcr.cli import main

if __name__ == "__main__":
    main()
