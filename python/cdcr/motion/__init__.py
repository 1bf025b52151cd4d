"""Motions to follow, and the tensions that make the robot follow them."""
