"""The claims of the origin paper, each computed beside what it says."""
