"""Tests of the learner against slow and obvious references."""
