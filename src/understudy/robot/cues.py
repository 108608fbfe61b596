"""The teacher's words (§4.2, §6, Appendix A.5)."""

from enum import StrEnum

__all__ = ["Cue"]


class Cue(StrEnum):
    """One spoken cue. The value is the word itself, as it stands in documents and recordings."""

    START = "START"
    """A demonstration begins; the robot starts following the teacher."""
    HERE = "HERE"
    """What the robot senses now is relevant to the task."""
    TAKE = "TAKE"
    """Pick up the small object in view; relevant, too."""
    DROP = "DROP"
    """Drop what the gripper holds; relevant, too."""
    REPEAT = "REPEAT"
    """What follows, up to UNTIL, is to be done again and again (§4.6)."""
    UNTIL = "UNTIL"
    """So long: what has just come to be so ends it."""
    DONE = "DONE"
    """The demonstration ends; the robot stops."""
    BAD = "BAD"
    """Practice: the step in execution, or just finished, does not belong to the task."""
    COME = "COME"
    """Practice: steps are missing here; follow me and learn them."""
    GO = "GO"
    """Practice: the missing steps have been shown; carry on."""
