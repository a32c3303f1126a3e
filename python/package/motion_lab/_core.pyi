"""The compiled part of the package."""

import os
from collections.abc import Sequence
from typing import Any, Literal, SupportsFloat, TypeAlias, final, overload

import numpy as np
import numpy.typing as npt
from typing_extensions import disjoint_base

from ._answers import Edge, Shape, Witness

__all__ = [
    "Certificate",
    "Checker",
    "ConfigurationError",
    "Disc",
    "Error",
    "Hitch",
    "LogError",
    "NoPath",
    "Obstacle",
    "Reach",
    "Resident",
    "Robot",
    "RunError",
    "Rusty",
    "World",
    "WorldError",
    "scan",
    "set_threads",
    "threads",
    "world_names",
]

_Floats: TypeAlias = npt.NDArray[np.float64]
_Bools: TypeAlias = npt.NDArray[np.bool_]
# one configuration: a tuple or a list of numbers
_One: TypeAlias = tuple[SupportsFloat, ...] | list[float] | list[int]
# any number of them, in arrays of any shape
_Many: TypeAlias = npt.ArrayLike
_World: TypeAlias = World | str

# questions

class Error(ValueError): ...

class WorldError(Error):
    path: str | None
    line: int | None
    column: int | None

class ConfigurationError(Error):
    name: str
    row: tuple[int, ...]

class LogError(Error): ...
class RunError(Error): ...
class NoPath(RuntimeError): ...

def world_names() -> list[str]: ...
def set_threads(n: int | None = None) -> None: ...
def threads() -> int: ...

@final
class World:
    def __new__(cls, name: str) -> World: ...
    @staticmethod
    def read(path: str | os.PathLike[str]) -> World: ...
    @staticmethod
    def parse(text: str, name: str = "<text>") -> World: ...
    @staticmethod
    def from_shapes(
        *,
        segments: npt.ArrayLike | None = None,
        boxes: npt.ArrayLike | None = None,
        discs: npt.ArrayLike | None = None,
        polygons: Sequence[npt.ArrayLike] | None = None,
        occupancy: _Bools | None = None,
        resolution: float | None = None,
        origin: tuple[float, float] | None = None,
        bounds: tuple[float, float, float, float] | None = None,
        name: str = "World",
    ) -> World: ...
    @property
    def name(self) -> str: ...
    @property
    def bounds(self) -> tuple[float, float, float, float]: ...
    @property
    def obstacles(self) -> tuple[Obstacle, ...]: ...
    @property
    def robots(self) -> tuple[Resident, ...]: ...
    @property
    def places(self) -> dict[str, tuple[float, float, float]]: ...
    def write(self, path: str | os.PathLike[str]) -> None: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, tuple[str]]: ...

@final
class Obstacle:
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> Literal["wall", "solid"]: ...
    @property
    def shapes(self) -> tuple[Shape, ...]: ...

@final
class Resident:
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def start(self) -> tuple[float, ...]: ...
    @property
    def robot(self) -> Robot | None: ...

@disjoint_base
class Robot:
    @property
    def coordinates(self) -> tuple[str, ...]: ...
    @property
    def units(self) -> tuple[str, ...]: ...
    @property
    def angles(self) -> tuple[int, ...]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class Disc(Robot):
    def __new__(cls, radius: float | None = None) -> Disc: ...
    @property
    def radius(self) -> float: ...

@final
class Rusty(Robot):
    def __new__(
        cls, radius: float | None = None, *, track: float | None = None, wheel_radius: float | None = None
    ) -> Rusty: ...
    @property
    def radius(self) -> float: ...

@final
class Reach(Robot):
    def __new__(
        cls,
        lengths: Sequence[float] | None = None,
        *,
        base: tuple[float, float] | None = None,
        radius: float | None = None,
    ) -> Reach: ...
    @property
    def lengths(self) -> tuple[float, ...]: ...

@final
class Hitch(Robot):
    def __new__(
        cls,
        trailer: bool = False,
        *,
        jackknife: float | None = None,
        wheelbase: float | None = None,
        length: float | None = None,
        width: float | None = None,
        rear_overhang: float | None = None,
        max_steer: float | None = None,
        hitch_length: float | None = None,
        trailer_width: float | None = None,
        trailer_front_overhang: float | None = None,
        trailer_rear_overhang: float | None = None,
    ) -> Hitch: ...
    @property
    def trailer(self) -> bool: ...

@final
class Checker:
    def __new__(cls, world: _World, robot: Robot) -> Checker: ...
    @property
    def world(self) -> World: ...
    @property
    def robot(self) -> Robot: ...
    @property
    def coordinates(self) -> tuple[str, ...]: ...
    @property
    def units(self) -> tuple[str, ...]: ...
    @property
    def angles(self) -> tuple[int, ...]: ...
    @overload
    def intersects(self, q: _One, *, out: None = None) -> bool: ...
    @overload
    def intersects(self, q: _Many, *, out: _Bools | None = None) -> _Bools: ...
    @overload
    def distance(self, q: _One, *, out: None = None) -> float: ...
    @overload
    def distance(self, q: _Many, *, out: _Floats | None = None) -> _Floats: ...
    @overload
    def is_free(self, q: _One, *, out: None = None) -> bool: ...
    @overload
    def is_free(self, q: _Many, *, out: _Bools | None = None) -> _Bools: ...
    def witness(self, q: _Many) -> Witness: ...
    @overload
    def swept(self, a: _One, b: _One, *, out: None = None) -> bool: ...
    @overload
    def swept(self, a: _Many, b: _Many, *, out: _Bools | None = None) -> _Bools: ...
    @overload
    def edge_free(self, a: _One, b: _One, *, out: None = None) -> bool: ...
    @overload
    def edge_free(self, a: _Many, b: _Many, *, out: _Bools | None = None) -> _Bools: ...
    def edge(self, a: _Many, b: _Many) -> Edge: ...
    def certificate(self, a: _Many, b: _Many) -> Certificate: ...
    def __getnewargs__(self) -> tuple[World, Robot]: ...

@final
class Certificate:
    def __new__(
        cls, checker: Checker, a: _Many, b: _Many, steps: npt.ArrayLike, margin: float = 0.0
    ) -> Certificate: ...
    def verify(self) -> float: ...
    @property
    def steps(self) -> _Floats: ...
    @property
    def proven_until(self) -> float: ...
    @property
    def clearance(self) -> float: ...
    @property
    def margin(self) -> float: ...
    def __len__(self) -> int: ...
    def __getnewargs__(self) -> tuple[Checker, tuple[float, ...], tuple[float, ...], _Floats, float]: ...

def scan(
    world: _World,
    poses: npt.ArrayLike,
    rays: int = 360,
    range: float = 4.0,
    *,
    field_of_view: float | None = None,
    out: _Floats | None = None,
) -> _Floats: ...
