"""Understudy: a robot that learns your task by following you, and gets better by practising it.

The package is laid out in rooms; imports point from the later room to the earlier one only
(``docs/design.md``). Two ways lead through the house:

* acting:   sensors -> observation -> percepts -> effects -> activation -> command
* learning: demonstration -> observed intervals -> network
"""

__version__ = "0.1.0"

__all__ = ["__version__"]
