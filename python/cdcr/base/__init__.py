"""What everything else stands on: checks of values, and imports that may be missing."""
