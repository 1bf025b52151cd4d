"""Scenario files of users: what they may hold, read and run."""
