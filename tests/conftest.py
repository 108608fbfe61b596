"""Hypothesis without deadlines: a loaded machine is no failure. Nothing here is timed."""

from hypothesis import settings

settings.register_profile("understudy", deadline=None)
settings.load_profile("understudy")
