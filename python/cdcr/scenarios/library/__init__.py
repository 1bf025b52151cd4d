"""The scenarios that ship with the package, one a file."""
