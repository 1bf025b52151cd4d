"""Numbers that the summary and the picture of a scenario share."""
