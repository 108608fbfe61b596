"""Practice under a teacher's feedback: BAD takes a step out, COME … GO puts missing ones in (§6)."""

from understudy.practice.attribution import Attribution, attributions
from understudy.practice.corrections import Correction, PracticeReport
from understudy.practice.edits import inserted, without
from understudy.practice.minutes import minutes_of, read_minutes
from understudy.practice.practising import LISTEN_S, Practice
from understudy.practice.reassigning import reassigned

__all__ = [
    "LISTEN_S",
    "Attribution",
    "Correction",
    "Practice",
    "PracticeReport",
    "attributions",
    "inserted",
    "minutes_of",
    "read_minutes",
    "reassigned",
    "without",
]
