"""``python -m cdcr``: the command line."""

from cdcr._cli import main

if __name__ == "__main__":
    main()
