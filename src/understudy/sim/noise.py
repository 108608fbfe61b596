"""How much the senses err, and where the randomness comes from."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from understudy.documents import Part
from understudy.robot import PIONEER
from understudy.sim.quantities import Level, Rate

__all__ = ["NoiseLevels", "NoiseStreams"]


class NoiseLevels(Part):
    """The ``noise`` of a world document: standard deviations and rates; zero switches one off.

    Attributes:
        laser: of a range, metres (§3.5.1: SICK LMS 200, ±15 mm).
        sonar: of a range, metres.
        image: of a pixel's channel, in 256 levels.
        illumination: of the light from picture to picture, as a share of it.
        odometry_scale: of the wheels' scale error, drawn once a run, as a share of the distance and of the turn.
        odometry_heading: random drift of the heading, radians for a metre driven or a radian turned.
        false_blobs: pictures with a patch of a color that is not there (§4.5.5), as a share of all.
        misread_colors: pictures in which a target or a box has another trained color than its own (§4.5.6), as a share
            of all.
        misread_s: how long the color that a thing is taken for lasts, on average, seconds; 0 for a single picture.
        beam_misreads: readings of the gripper's beam that are wrong, as a share of all.
    """

    laser: Level = PIONEER.laser.noise_std
    sonar: Level = 0.02
    image: Level = 5.0
    illumination: Level = 0.04
    odometry_scale: Level = 0.015
    odometry_heading: Level = 0.01
    false_blobs: Rate = 0.02
    misread_colors: Rate = 0.0
    misread_s: Level = 0.0
    beam_misreads: Rate = 0.0002

    @classmethod
    def none(cls) -> Self:
        """Perfect senses."""
        return cls(**dict.fromkeys(cls.model_fields, 0.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseStreams:
    """One random generator a sense, so that a change in one sense leaves the others' errors as they were."""

    laser: np.random.Generator
    sonar: np.random.Generator
    camera: np.random.Generator
    odometry: np.random.Generator
    gripper: np.random.Generator
    colors: np.random.Generator

    @classmethod
    def spawn(cls, seed: np.random.SeedSequence) -> Self:
        """Independent streams for one robot."""
        laser, sonar, camera, odometry, gripper, colors = (np.random.default_rng(child) for child in seed.spawn(6))
        return cls(laser=laser, sonar=sonar, camera=camera, odometry=odometry, gripper=gripper, colors=colors)
