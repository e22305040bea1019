"""Daylight of a year: hours of a weather file, what sensors get in each, and verdicts. The command rsphere-annual does all of it.

    weather = rsphere.annual.read_weather("town.epw")
    light = rsphere.annual.Light(["room.rad"], sensors, weights, weather, [], folder, rsphere.annual.Settings())
    light.add()  # one more estimate; light.year has all, in lx
    rsphere.annual.verdicts_of(light.year)
"""
from .light import Light
from .passes import Settings
from .verdicts import Verdict, Year, quantities_of, verdicts_of
from .weather import Weather, read_weather

__all__ = ["Light", "Settings", "Verdict", "Weather", "Year", "quantities_of", "read_weather", "verdicts_of"]
