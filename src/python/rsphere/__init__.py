"""Light in scenes of RADIANCE's format: along rays and at points.

    scene = rsphere.Scene(["sky.rad", "room.rad"])
    answers = scene.sphere([[4, 2.6, 1.2]], ambient_bounces=5)
    rsphere.photometric(answers.scalar_irradiance)  # lx

Calls use all cores, release the lock of the interpreter, and end with KeyboardInterrupt on Ctrl-C. Answers do
not depend on the number of threads. Warnings about the scene are UserWarning.

rsphere.annual: daylight of a year; rsphere.layout: where luminaires should hang; rsphere.photometry: files of luminaires.
"""
from ._rsphere import LUMENS_PER_WATT, Error, Scene, __version__, photometric, zone_middles
from .answers import Answers

__all__ = ["Answers", "LUMENS_PER_WATT", "Error", "Scene", "__version__", "photometric", "zone_middles"]
