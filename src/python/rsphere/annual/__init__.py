"""Daylight of a year: hours of a weather file, luminances of the sky, what sensors get of them. The command is rsphere-annual."""
