"""Tests of behavior-network execution, with an independent reference to compare against."""
