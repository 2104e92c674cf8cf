"""Longitude and latitude to local metres and back: a transverse Mercator projection of its own for each track."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.polynomial import polyval

from bobdesk.arrays import FloatArray

# WGS 84
_SEMI_MAJOR = 6_378_137.0
_FLATTENING = 1 / 298.257223563
_ECCENTRICITY = (_FLATTENING * (2 - _FLATTENING)) ** 0.5
_N = _FLATTENING / (2 - _FLATTENING)
_RADIUS = _SEMI_MAJOR / (1 + _N) * (1 + _N**2 / 4 + _N**4 / 64)
_ORDERS = np.arange(1, 5)
_FORWARD = np.array(
    [
        polyval(_N, [0, 1 / 2, -2 / 3, 5 / 16, 41 / 180]),
        polyval(_N, [0, 0, 13 / 48, -3 / 5, 557 / 1440]),
        polyval(_N, [0, 0, 0, 61 / 240, -103 / 140]),
        polyval(_N, [0, 0, 0, 0, 49561 / 161280]),
    ]
)
_BACK = np.array(
    [
        polyval(_N, [0, 1 / 2, -2 / 3, 37 / 96, -1 / 360]),
        polyval(_N, [0, 0, 1 / 48, 1 / 15, -437 / 1440]),
        polyval(_N, [0, 0, 0, 17 / 480, -37 / 840]),
        polyval(_N, [0, 0, 0, 0, 4397 / 161280]),
    ]
)
_LATITUDE_ROUNDS = 8  # each gains a factor of 150
LARGEST_LATITUDE = 89.9
LARGEST_LONGITUDE = 360.0


@dataclass(frozen=True)
class Georeference:
    """Where on the Earth the plan's origin lies.

    Metres count from here in a transverse Mercator projection on WGS 84 whose central meridian runs
    through the origin, with a scale of 1 there: x east, y north. On a track they are true to 1e-8.

    Attributes
    ----------
    longitude, latitude
        Of the origin (0, 0), degrees, east and north positive.
    """

    longitude: float
    latitude: float


def is_place(longitude: float | None, latitude: float | None) -> bool:
    """Return whether a longitude and a latitude can be the origin of a plan."""
    if longitude is None or latitude is None:
        return False
    return abs(longitude) <= LARGEST_LONGITUDE and abs(latitude) <= LARGEST_LATITUDE


def to_metres(degrees: FloatArray, georeference: Georeference) -> FloatArray:
    """Project longitudes and latitudes.

    Parameters
    ----------
    degrees : (n, 2)
        Longitude and latitude, finite; within about 1,000 km of the origin.

    Returns
    -------
    (n, 2)
        x and y, m.

    References
    ----------
    L. Krueger, Konforme Abbildung des Erdellipsoids in der Ebene (1912); the coefficients as in
    C. F. F. Karney, Transverse Mercator with an accuracy of a few nanometers, J. Geodesy 85 (2011).
    """
    east = np.remainder(degrees[:, 0] - georeference.longitude + 180.0, 360.0) - 180.0
    northing, easting = _projected(np.radians(east), np.radians(degrees[:, 1]))
    start, _ = _projected(np.zeros(1), np.radians(np.array([georeference.latitude])))
    return np.column_stack([easting, northing - start[0]])


def to_degrees(metres: FloatArray, georeference: Georeference) -> FloatArray:
    """Return longitude and latitude, (n, 2), degrees, of x and y, (n, 2), m; the inverse of `to_metres`."""
    start, _ = _projected(np.zeros(1), np.radians(np.array([georeference.latitude])))
    xi = (metres[:, 1] + start[0]) / _RADIUS
    eta = metres[:, 0] / _RADIUS
    twice = 2 * _ORDERS
    xi_sphere = xi - np.sin(np.outer(xi, twice)) * np.cosh(np.outer(eta, twice)) @ _BACK
    eta_sphere = eta - np.cos(np.outer(xi, twice)) * np.sinh(np.outer(eta, twice)) @ _BACK
    conformal = np.arctanh(np.sin(xi_sphere) / np.cosh(eta_sphere))
    latitude = np.arctan(np.sinh(conformal))
    for _ in range(_LATITUDE_ROUNDS):
        shift = _ECCENTRICITY * np.arctanh(_ECCENTRICITY * np.sin(latitude))
        latitude = np.arctan(np.sinh(conformal + shift))
    longitude = georeference.longitude + np.degrees(np.arctan2(np.sinh(eta_sphere), np.cos(xi_sphere)))
    longitude = np.remainder(longitude + 180.0, 360.0) - 180.0
    return np.column_stack([longitude, np.degrees(latitude)])


def _projected(longitude: FloatArray, latitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return northing from the equator and easting, m, of radians."""
    sine = np.sin(latitude)
    tangent = np.sinh(np.arctanh(sine) - _ECCENTRICITY * np.arctanh(_ECCENTRICITY * sine))
    xi = np.arctan2(tangent, np.cos(longitude))
    eta = np.arcsinh(np.sin(longitude) / np.hypot(tangent, np.cos(longitude)))
    twice = 2 * _ORDERS
    northing = xi + np.sin(np.outer(xi, twice)) * np.cosh(np.outer(eta, twice)) @ _FORWARD
    easting = eta + np.cos(np.outer(xi, twice)) * np.sinh(np.outer(eta, twice)) @ _FORWARD
    return _RADIUS * northing, _RADIUS * easting
