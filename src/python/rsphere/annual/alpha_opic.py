"""What daylight does to the five receptors of the eye, at eyes: alpha-opic equivalent daylight illuminances (CIE S 026:2018).

Sky and sun have the spectrum of D65; surfaces and panes color it, in 20 bands. A scene without colors has equal values of all.
"""
import numpy as np

from .verdicts import FROM, UNTIL, Verdict, Year, estimated, hours_of, share

BANDS = 20  # of 20 nm, from 780 nm down to 380 nm
OBSERVERS = ("illuminance", "S-cone-opic EDI", "M-cone-opic EDI", "L-cone-opic EDI", "rhodopic EDI", "melanopic EDI")
MELANOPIC = OBSERVERS.index("melanopic EDI")
# Shares of the bands in the response of each observer to D65: V(lambda) of 1931, and the action spectra of CIE S 026:2018, table 2 (dataset
# 10.25039/CIE.DS.vqqhzp5a, read in the repository tscnlab/LightLogR), times D65 of CIE 15, summed at steps of 1 nm.
SHARES = np.array("""
  .000004 .000016 .000072 .000304 .00125 .005274 .017048 .043288 .085233 .129948 .17385 .192875 .171108 .103087 .045051 .020581 .008542 .00219 .000262 .000019
  0 0 0 0 0 0 0 0 .000001 .000009 .00006 .000442 .002947 .017249 .075319 .236699 .367133 .234555 .063297 .002288
  0 .000001 .000005 .000023 .000105 .000517 .002302 .009556 .032633 .078886 .14214 .188452 .193293 .151502 .097563 .059898 .030667 .010356 .002025 .000077
  .000004 .000017 .000072 .000335 .001494 .006557 .021329 .05381 .101202 .138714 .163491 .165865 .142113 .096469 .054434 .030192 .015682 .00644 .001705 .000076
  0 0 0 .000001 .000005 .000025 .000117 .000601 .002971 .012132 .039775 .095593 .163331 .202022 .189972 .149927 .099256 .036699 .00717 .000401
  0 0 0 0 .000001 .000004 .000016 .000083 .000458 .002522 .012933 .048062 .115683 .191464 .228655 .20591 .132628 .050522 .010485 .000574
""".split(), float).reshape(len(OBSERVERS), BANDS)
LIMITS = (150, 275)  # lx, of the melanopic EDI
SOURCE = f"CIE S 026:2018, melanopic EDI at eyes by daylight of D65, {FROM} to {UNTIL} h with shades; limits of WELL v2, L03, whose hours were not read"


def by_observers(value):
    """Of coefficients in bands (eyes, ..., BANDS): those of all observers, one after the other, (observers * eyes, ...)."""
    found = np.moveaxis(value @ SHARES.T, -1, 0)
    return found.reshape(-1, *found.shape[2:])


def melanopic_year(year, lux):
    """The Year of the melanopic EDI. lux: (estimates, observers * eyes, hours), in the order of by_observers()."""
    parts = lux.reshape(len(lux), len(OBSERVERS), -1, lux.shape[-1])
    eyes = parts.shape[2]
    return Year(year.rows, parts[:, MELANOPIC], parts[:, MELANOPIC], None, year.diffuse, year.sun, np.full(eyes, 1 / eyes), year.all_hours,
                year.occupied_hours)


def verdicts_of_eyes(year):
    """Shares of eyes, of the Year of melanopic_year()."""
    for limit in LIMITS:
        hours = hours_of(limit, year.occupied(), year.occupied_hours)
        yield share(year, hours, year.lux, 0.5, rule=f"eyes with {limit} lx in half of the hours", asked="", least=float("nan"), source=SOURCE)
        mean, error = estimated(lambda lux, hours=hours: hours(lux).mean(), year.lux)
        yield Verdict(f"hours with {limit} lx, mean of the eyes", "", float(mean), float("nan"), SOURCE, float(error))


def quantities_of_eyes(year, lux):
    """By name: values of eyes from FROM to UNTIL h, their standard errors and a unit."""
    parts = lux.reshape(len(lux), len(OBSERVERS), -1, lux.shape[-1])
    chosen, count = year.occupied(), year.occupied_hours
    found = {f"mean {name}": (*estimated(lambda x: x[:, chosen].sum(axis=1) / count, parts[:, i]), "lx") for i, name in enumerate(OBSERVERS)}
    for limit in LIMITS:
        found[f"melanopic EDI of {limit} lx"] = (*estimated(hours_of(limit, chosen, count), parts[:, MELANOPIC]), "%")
    return found
