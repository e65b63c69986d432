"""Continuum mechanics at compiled speed.

Laws of solids over NumPy arrays, fluids and their viscometric flows, fits of both to measurements, and scenes of motion.

>>> import numpy as np, piola
>>> rubber = piola.Solid("saint_venant_kirchhoff", first_lame_parameter=1.0, shear_modulus=2.0)
>>> f = np.diag([2.0, 1.0, 1.0])            # one deformation gradient; (n, 3, 3) for many
>>> float(rubber.stress(f)[0, 0])           # F11^2 (lambda + 2 mu) E11/J, Pa
15.0

Arrays of float64 in C order cross without a copy. Evaluations release the global interpreter lock. What the library refuses is a
``ValueError`` with the message of the library.
"""

from __future__ import annotations

import json as _json
from typing import Any, Iterable, Mapping, Sequence

import numpy as np

from . import _native

__version__: str = _native.VERSION
__all__ = ["Couette", "Fluid", "History", "Pipe", "Run", "Solid", "fit_fluid", "fit_solid", "run_scene"]


def _written(kind: str, name: str, parameters: Mapping[str, Any]) -> str:
    """The written form of a law: its name and its parameters by name."""

    def plain(value: Any) -> Any:
        if isinstance(value, (np.ndarray, np.generic)):
            return value.tolist()
        raise TypeError(f"{type(value).__name__} is no parameter: give numbers, lists and dictionaries")

    return _json.dumps({kind: name, **parameters}, default=plain, allow_nan=False)


def _array(name: str, values: Any, tail: tuple[int, ...] = ()) -> np.ndarray:
    """An array of float64 in C order, the same memory where it is one already."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    if tail and array.shape[-len(tail) :] != tail:
        raise ValueError(f"`{name}` has shape {array.shape}; its last axes must be {tail}")
    # NumPy makes a number an array of one axis here.
    return array.reshape(np.shape(values)) if array.ndim != np.ndim(values) else array


def _output(out: np.ndarray | None, shape: tuple[int, ...]) -> np.ndarray:
    """The caller's array, or a new one."""
    if out is None:
        return np.empty(shape)
    if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape:
        found = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ValueError(f"`out` is {found}; float64 {shape} is needed")
    if not out.flags.c_contiguous or not out.flags.writeable:
        raise ValueError("`out` must be writeable and in C order")
    return out


def _choice(name: str, value: str, valid: tuple[str, ...]) -> str:
    if value not in valid:
        raise ValueError(f"`{name}` is {value!r}; it can be {', '.join(valid)}")
    return value


class Solid:
    """A law of a solid, by its name and its parameters.

    ======================================== ============================================================
    law                                      parameters
    ======================================== ============================================================
    ``mooney_rivlin``                        c10, c01, square_coefficient
    ``neo_hookean``, ``hencky``              shear_modulus, volumetric
    ``compressible``                         isochoric, volumetric
    ``incompressible``                       isochoric
    ``blatz_ko``                             shear_modulus, poisson_ratio, solid_fraction
    ``saint_venant_kirchhoff``               first_lame_parameter, shear_modulus
    ``linear_elastic``                       shear_modulus, first_lame_parameter
    ``ogden``, ``isochoric_ogden``           terms: [{"modulus": ..., "exponent": ...}, ...], volumetric
    ``incompressible_ogden``                 terms
    ``holzapfel_gasser_ogden``               shear_modulus, bulk_modulus, fibre_modulus, fibre_exponent,
                                             dispersion, fibres
    ``reinforced_neo_hookean``               shear_modulus, first_lame_parameter, fibre_modulus, fibre
    ``polynomial``, ``fung``,                as in the reference of the Rust type ``AnySolid``
    ``anisotropic_linear``,
    ``anisotropic_saint_venant_kirchhoff``
    ======================================== ============================================================

    ``isochoric`` is a dictionary with the law ``neo_hookean``, ``mooney_rivlin``, ``yeoh``, ``rivlin``, ``gent``, ``arruda_boyce`` or
    ``arruda_boyce_series``; ``volumetric`` one with ``quadratic``, ``logarithmic``, ``lame``, ``quadratic_logarithmic``,
    ``simo_taylor``, ``liu``, ``miehe``, ``ogden`` or ``hartmann_neff``. Moduli are in Pa.

    >>> gent = Solid(
    ...     "compressible",
    ...     isochoric={"law": "gent", "shear_modulus": 1e6, "limit": 50.0},
    ...     volumetric={"law": "simo_taylor", "bulk_modulus": 1e9},
    ... )
    """

    __slots__ = ("_solid",)

    def __init__(self, law: str, **parameters: Any) -> None:
        self._solid = _native.Solid(_written("law", law, parameters))

    @classmethod
    def _of(cls, solid: Any) -> Solid:
        made = cls.__new__(cls)
        made._solid = solid
        return made

    @classmethod
    def from_json(cls, text: str) -> Solid:
        """The law of its written form, such as ``solid.to_json()`` gives."""
        return cls._of(_native.Solid(text))

    @classmethod
    def from_fit(cls, summary: str, model: str | None = None, volumetric: Mapping[str, Any] | None = None) -> Solid:
        """The law of a fit, from the text of the ``summary.json`` that the program ``piola fit`` writes.

        ``model`` chooses one of its laws; without it the best by AICc is taken. ``volumetric`` is the energy of the change of
        volume, such as ``{"law": "quadratic", "bulk_modulus": 1e9}``; without it the law is incompressible. Parameters are converted
        from the unit of stress of the fit to Pa.
        """
        volume = None if volumetric is None else _json.dumps(dict(volumetric))
        return cls._of(_native.Solid.from_fit(summary, model, volume))

    @classmethod
    def from_values(cls, name: str, values: Sequence[float]) -> Solid:
        """The law of a name with its parts and numbers in their order: ``from_values("hencky-lame", [mu, lam])``."""
        return cls._of(_native.Solid.from_values(name, [float(value) for value in values]))

    def to_json(self) -> str:
        """The written form of the law."""
        return self._solid.json()

    @property
    def parameters(self) -> dict[str, Any]:
        """The law and its parameters by name."""
        return _json.loads(self._solid.json())

    def __repr__(self) -> str:
        return f"Solid({self.to_json()})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Solid) and self.parameters == other.parameters

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return (Solid.from_json, (self.to_json(),))

    def energy(self, f: Any, *, out: np.ndarray | None = None, bad_points: str = "raise") -> np.ndarray:
        """Strain energy W(F) - W(1), J/m^3 of the reference, at deformation gradients ``f`` of shape (..., 3, 3); shape (...).

        ``out`` and ``bad_points`` are as in :meth:`stress`. Points are computed one after the other, not in lanes.

        >>> bar = np.diag([2.0, 1.0, 1.0])
        >>> law = Solid("saint_venant_kirchhoff", first_lame_parameter=1.0, shear_modulus=2.0)
        >>> float(law.energy(bar))              # (lambda/2 + mu) E11^2
        5.625
        """
        f = _array("f", f, (3, 3))
        result = _output(out, f.shape[:-2])
        _choice("bad_points", bad_points, ("raise", "nan"))
        message = self._solid.energy(f.reshape(-1), result.reshape(-1))
        if message is not None and bad_points == "raise":
            raise ValueError(message)
        return result

    def stress(
        self, f: Any, measure: str = "cauchy", *, out: np.ndarray | None = None, bad_points: str = "raise"
    ) -> np.ndarray:
        """Stress, Pa, at deformation gradients ``f`` of shape (..., 3, 3); the result has the same shape.

        ================= ===================================================
        measure           formula
        ================= ===================================================
        ``cauchy``        T = P F^T/J
        ``first_piola``   P = dW/dF
        ``second_piola``  S = F^-1 P
        ================= ===================================================

        ``out`` is an array for the result. Where F is not finite, 0 < det F fails or the law has no answer, the point is bad: a
        ``ValueError``, or NaN at these points with ``bad_points="nan"``. All other points are computed in either case.
        """
        f = _array("f", f, (3, 3))
        result = _output(out, f.shape)
        _choice("bad_points", bad_points, ("raise", "nan"))
        message = self._solid.stress(measure, f.reshape(-1), result.reshape(-1))
        if message is not None and bad_points == "raise":
            raise ValueError(message)
        return result

    def tangent(
        self,
        f: Any,
        measure: str = "first_piola",
        *,
        voigt: str = "piola",
        out: np.ndarray | None = None,
        bad_points: str = "raise",
    ) -> np.ndarray:
        """Tangent, Pa, at deformation gradients ``f`` of shape (..., 3, 3).

        ================= ========================================================= =====================
        measure           tangent                                                   shape
        ================= ========================================================= =====================
        ``first_piola``   A_iAjB = dP_iA/dF_jB                                      (..., 3, 3, 3, 3)
        ``material``      dS/dE                                                     (..., 6, 6)
        ``truesdell``     D to Truesdell's rate of T                                (..., 6, 6)
        ``jaumann``       D to Jaumann's rate of tau, over J: DDSDDE of Abaqus      (..., 6, 6)
        ================= ========================================================= =====================

        Matrices of 6 by 6 multiply engineering shears. ``voigt`` is their order: ``piola`` 11, 22, 33, 12, 23, 13; ``abaqus`` 11, 22, 33,
        12, 13, 23; ``classical`` 11, 22, 33, 23, 13, 12. For ``out`` and ``bad_points`` see :meth:`stress`.
        """
        f = _array("f", f, (3, 3))
        result = _output(out, f.shape[:-2] + _tangent_shape(measure))
        _choice("bad_points", bad_points, ("raise", "nan"))
        message = self._solid.tangent(measure, voigt, f.reshape(-1), result.reshape(-1))
        if message is not None and bad_points == "raise":
            raise ValueError(message)
        return result

    def stress_and_tangent(
        self,
        f: Any,
        measures: tuple[str, str] = ("first_piola", "first_piola"),
        *,
        voigt: str = "piola",
        out: tuple[np.ndarray, np.ndarray] | None = None,
        bad_points: str = "raise",
    ) -> tuple[np.ndarray, np.ndarray]:
        """Stress and tangent with the law evaluated once for both: see :meth:`stress` and :meth:`tangent`."""
        f = _array("f", f, (3, 3))
        first, second = (None, None) if out is None else out
        stress = _output(first, f.shape)
        tangent = _output(second, f.shape[:-2] + _tangent_shape(measures[1]))
        _choice("bad_points", bad_points, ("raise", "nan"))
        names = (measures[0], measures[1], voigt)
        message = self._solid.stress_and_tangent(names, f.reshape(-1), stress.reshape(-1), tangent.reshape(-1))
        if message is not None and bad_points == "raise":
            raise ValueError(message)
        return stress, tangent


def _tangent_shape(measure: str) -> tuple[int, ...]:
    _choice("measure", measure, ("first_piola", "material", "truesdell", "jaumann"))
    return (3, 3, 3, 3) if measure == "first_piola" else (6, 6)


class History:
    """A law with history, by its name and its parameters.

    ===================== ==================================================================== =================================
    law                   parameters                                                           internal variables
    ===================== ==================================================================== =================================
    ``bergstrom_boyce``   equilibrium, overstress, flow: {"rate": ..., "stress": ...,          9: F_i by rows
                          "stress_exponent": ..., "stretch_exponent": ..., "perturbation": ...}
    ``reese_govindjee``   equilibrium, overstress, viscosity, bulk_fluidity                    9: F_i by rows
    ``in_series``         first, second, viscosity                                             9: F_i by rows
    ``viscoplastic``      elastic, hardening: {"yield_stress": ..., "linear": ...,             10: F_i by rows, accumulated strain
                          "saturation": ..., "saturation_exponent": ...}, viscosity
    ``kinematic``         elastic, back, hardening, recovery, viscosity                        19: the same, F_k by rows
    ``mullins``           elastic, softening, energy, share                                    1: the largest energy
    ``driven_growth``     elastic, rate, bounds: [...], exponent                               1: the stretch of growth
    ``given_growth``      elastic                                                              9: G by rows, which you write
    ``thermal``           elastic, expansion: {"coefficient": ..., "reference_temperature":    1: the temperature, which you write
                          ...}
    ===================== ==================================================================== =================================

    Elastic parts are dictionaries with the key ``law`` and the parameters of a :class:`Solid`. Those that flow must be isotropic.

    >>> spring = {"law": "neo_hookean", "shear_modulus": 1.0, "volumetric": {"law": "simo_taylor", "bulk_modulus": 2.0}}
    >>> law = History("reese_govindjee", equilibrium=spring, overstress=spring, viscosity=0.5, bulk_fluidity=0.0)
    >>> still, shear = np.eye(3), np.array([[1.0, 0.3, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    >>> stress, state = law.advance(still, shear, 1e-6)            # at once: 2 mu k
    >>> stress, state = law.advance(shear, shear, 1e3, state)      # held: mu k
    >>> round(float(stress[0, 1]), 3)
    0.3
    """

    __slots__ = ("_history",)

    def __init__(self, law: str, **parameters: Any) -> None:
        self._history = _native.History(_written("law", law, parameters))

    @classmethod
    def _of(cls, history: Any) -> History:
        made = cls.__new__(cls)
        made._history = history
        return made

    @classmethod
    def from_json(cls, text: str) -> History:
        """The law of its written form, such as ``history.to_json()`` gives."""
        return cls._of(_native.History(text))

    @classmethod
    def from_fit(cls, summary: str, model: str | None = None) -> History:
        """The law of a fit of laws with history, from the text of the ``summary.json`` that ``piola fit`` writes.

        ``model`` chooses one of its laws, such as ``reese-govindjee``; without it the best by AICc is taken. Parameters are converted
        from the unit of stress of the fit to Pa.
        """
        return cls._of(_native.History.from_fit(summary, model))

    @classmethod
    def from_values(cls, name: str, values: Sequence[float]) -> History:
        """The law of a name with its parts and numbers in their order: ``from_values("mullins-hencky-lame", [mu, lam, r, m, beta])``."""
        return cls._of(_native.History.from_values(name, [float(value) for value in values]))

    def to_json(self) -> str:
        """The written form of the law."""
        return self._history.json()

    @property
    def parameters(self) -> dict[str, Any]:
        """The law and its parameters by name."""
        return _json.loads(self._history.json())

    def __repr__(self) -> str:
        return f"History({self.to_json()})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, History) and self.parameters == other.parameters

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return (History.from_json, (self.to_json(),))

    @property
    def state_length(self) -> int:
        """The number S of internal variables."""
        return self._history.state_length()

    def initial_states(self, shape: int | tuple[int, ...] = (), *, layout: str = "rows") -> np.ndarray:
        """States of points of the body as it was made: shape (..., S), or (S, ...) with ``layout="components"``."""
        shape = (shape,) if isinstance(shape, int) else tuple(shape)
        states = np.empty(self._state_shape(shape, layout))
        self._history.initial_states(layout, states.reshape(-1))
        return states

    def _state_shape(self, shape: tuple[int, ...], layout: str) -> tuple[int, ...]:
        _choice("layout", layout, ("rows", "components"))
        return (*shape, self.state_length) if layout == "rows" else (self.state_length, *shape)

    def advance(
        self,
        before: Any,
        after: Any,
        dt: float,
        state: Any = None,
        measure: str = "cauchy",
        *,
        tangent: str | None = None,
        voigt: str = "piola",
        tolerance: float | None = None,
        layout: str = "rows",
        out: tuple[np.ndarray | None, ...] | None = None,
        bad_points: str = "raise",
    ) -> tuple[np.ndarray, ...]:
        """One increment from deformation gradients ``before`` to ``after``, shapes (..., 3, 3), in ``dt`` seconds.

        Returns the stress and the new state; with ``tangent`` the stress, the consistent tangent and the new state. ``measure`` and
        ``tangent`` are as in :meth:`Solid.stress` and :meth:`Solid.tangent`; tangents of 6 by 6 numbers are not symmetric in general.

        ``state`` is that of :meth:`initial_states` where it is left out. It stays as it is. ``out`` takes arrays of yours for what is
        returned, each an array or ``None``; that of the new state must be other memory than ``state``. ``tolerance`` bounds the
        estimated error of the internal variables; without it the increment is one implicit step.

        Where the update fails the point is bad: a ``ValueError``, or NaN in stress and tangent with ``bad_points="nan"``; its new state is
        the one before. All other points are advanced in either case.
        """
        after = _array("after", after, (3, 3))
        before = _array("before", np.broadcast_to(np.asarray(before, dtype=np.float64), after.shape), (3, 3))
        shape = after.shape[:-2]
        states = self._state_shape(shape, layout)
        state = self.initial_states(shape, layout=layout) if state is None else _array("state", state)
        if state.shape != states:
            raise ValueError(f"`state` has shape {state.shape}; {states} is needed")
        wanted = 2 if tangent is None else 3
        given: tuple[np.ndarray | None, ...] = (None,) * wanted if out is None else tuple(out)
        if len(given) != wanted:
            raise ValueError(f"`out` has {len(given)} arrays; {wanted} are returned")
        stress, new = _output(given[0], after.shape), _output(given[-1], states)
        if np.may_share_memory(state, new):
            raise ValueError("`out` of the new state must be other memory than `state`")
        square = None if tangent is None else _output(given[1], shape + _tangent_shape(tangent))
        _choice("bad_points", bad_points, ("raise", "nan"))
        message = self._history.advance(
            (measure, tangent or "first_piola", voigt, layout),
            (before.reshape(-1), after.reshape(-1)),
            (float(dt), None if tolerance is None else float(tolerance)),
            state.reshape(-1),
            new.reshape(-1),
            stress.reshape(-1),
            None if square is None else square.reshape(-1),
        )
        if message is not None and bad_points == "raise":
            raise ValueError(message)
        return (stress, new) if square is None else (stress, square, new)


class Fluid:
    """A fluid, by its name and its parameters.

    ========================================================= ==================================================
    fluid                                                     parameters
    ========================================================= ==================================================
    ``newtonian``                                             viscosity_coefficient
    ``power_law``                                             consistency, exponent
    ``bingham``, ``casson``                                   yield_stress, plastic_viscosity
    ``herschel_bulkley``                                      yield_stress, consistency, exponent
    ``carreau_yasuda``                                        zero_rate_viscosity, infinite_rate_viscosity, time,
                                                              exponent, transition
    ``cross``                                                 zero_rate_viscosity, infinite_rate_viscosity, time,
                                                              exponent
    ``oldroyd_b``                                             solvent_viscosity, polymer_viscosity, time
    ``giesekus``                                              the same, mobility
    others                                                    as in the reference of the Rust type ``AnyFluid``
    ========================================================= ==================================================

    >>> mud = Fluid("bingham", yield_stress=3.0, plastic_viscosity=0.5)
    >>> float(mud.shear_stress(4.0))            # tau_y + mu k, Pa
    5.0
    """

    __slots__ = ("_fluid",)

    def __init__(self, fluid: str, **parameters: Any) -> None:
        self._fluid = _native.Fluid(_written("fluid", fluid, parameters))

    @classmethod
    def from_json(cls, text: str) -> Fluid:
        """The fluid of its written form."""
        made = cls.__new__(cls)
        made._fluid = _native.Fluid(text)
        return made

    def to_json(self) -> str:
        """The written form of the fluid."""
        return self._fluid.json()

    @property
    def parameters(self) -> dict[str, Any]:
        """The fluid and its parameters by name."""
        return _json.loads(self._fluid.json())

    def __repr__(self) -> str:
        return f"Fluid({self.to_json()})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fluid) and self.parameters == other.parameters

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return (Fluid.from_json, (self.to_json(),))

    def _viscometric(self, function: str, entries: Any) -> np.ndarray:
        entries = _array("entries", entries)
        result = np.empty(entries.shape)
        self._fluid.viscometric(function, entries.reshape(-1), result.reshape(-1))
        return result

    @property
    def yield_stress(self) -> float:
        """The stress below which the fluid is at rest, Pa."""
        return self._fluid.yield_stress()

    def shear_stress(self, shear_rate: Any) -> np.ndarray:
        """tau(k), Pa, at shear rates k, 1/s, of any shape."""
        return self._viscometric("shear_stress", shear_rate)

    def viscosity(self, shear_rate: Any) -> np.ndarray:
        """tau/k, Pa s, at shear rates, 1/s."""
        return self._viscometric("viscosity", shear_rate)

    def first_normal_stress_difference(self, shear_rate: Any) -> np.ndarray:
        """N1 = T22 - T11, Pa, at shear rates, 1/s; direction 1 is that of the gradient, 2 that of the flow."""
        return self._viscometric("first_normal_stress_difference", shear_rate)

    def second_normal_stress_difference(self, shear_rate: Any) -> np.ndarray:
        """N2 = T11 - T33, Pa, at shear rates, 1/s."""
        return self._viscometric("second_normal_stress_difference", shear_rate)

    def shear_rate(self, shear_stress: Any) -> np.ndarray:
        """The inverse of tau, 1/s, at shear stresses, Pa; zero up to the yield stress."""
        return self._viscometric("shear_rate", shear_stress)


def _drive(first: str, a: float | None, second: str, b: float | None) -> None:
    if (a is None) == (b is None):
        raise ValueError(f"give either `{first}` or `{second}`")


class Pipe:
    """Steady flow along a pipe of circular cross section.

    T_rz = -c r/2, v(r) = integral of zeta(c xi/2) from r to R, Q = pi times the integral of xi^2 zeta(c xi/2) from 0 to R, with zeta the
    shear rate of a shear stress.

    Give the pressure gradient c = -dp/dz, Pa/m, or the discharge Q, m^3/s; the other one is found, with its error bound.

    >>> oil = Fluid("newtonian", viscosity_coefficient=0.5)
    >>> round(Pipe(oil, 2.0, pressure_gradient=3.0).discharge / np.pi, 12)      # c R^4/(8 mu)
    12.0
    """

    __slots__ = ("discharge", "error", "fluid", "pressure_gradient", "radius")

    def __init__(
        self, fluid: Fluid, radius: float, *, pressure_gradient: float | None = None, discharge: float | None = None
    ) -> None:
        _drive("pressure_gradient", pressure_gradient, "discharge", discharge)
        self.fluid = fluid
        self.radius = float(radius)
        if pressure_gradient is not None:
            self.pressure_gradient = float(pressure_gradient)
            self.discharge, self.error = fluid._fluid.pipe_discharge(radius, pressure_gradient)
        else:
            assert discharge is not None
            self.discharge = float(discharge)
            self.pressure_gradient, self.error = fluid._fluid.pipe_pressure_gradient(radius, discharge)

    def velocity(self, r: Any) -> np.ndarray:
        """Velocity, m/s, at distances r, m, from the axis."""
        r = _array("r", r)
        result = np.empty(r.shape)
        self.fluid._fluid.pipe_velocities(self.radius, self.pressure_gradient, r.reshape(-1), result.reshape(-1))
        return result


class Couette:
    """Steady flow between coaxial cylinders, the inner one at rest.

    T_rtheta = M/(2 pi r^2), r omega' = zeta(T_rtheta).

    Give the moment M per length, N m/m, or the difference of the angular velocities, rad/s; the other one is found, with its error
    bound.

    >>> oil = Fluid("newtonian", viscosity_coefficient=0.5)
    >>> round(Couette(oil, 1.0, 2.0, speed_difference=3.0).moment / np.pi, 12)
    8.0
    """

    __slots__ = ("error", "fluid", "inner_radius", "moment", "outer_radius", "speed_difference")

    def __init__(
        self,
        fluid: Fluid,
        inner_radius: float,
        outer_radius: float,
        *,
        moment: float | None = None,
        speed_difference: float | None = None,
    ) -> None:
        _drive("moment", moment, "speed_difference", speed_difference)
        self.fluid = fluid
        self.inner_radius, self.outer_radius = float(inner_radius), float(outer_radius)
        radii = (self.inner_radius, self.outer_radius)
        if moment is not None:
            self.moment = float(moment)
            self.speed_difference, self.error = fluid._fluid.couette_speed_difference(radii, moment)
        else:
            assert speed_difference is not None
            self.speed_difference = float(speed_difference)
            self.moment, self.error = fluid._fluid.couette_moment(radii, speed_difference)

    def angular_velocity(self, r: Any) -> np.ndarray:
        """Angular velocity, rad/s, at distances r, m, from the axis."""
        r = _array("r", r)
        result = np.empty(r.shape)
        radii = (self.inner_radius, self.outer_radius)
        self.fluid._fluid.couette_angular_velocities(radii, self.moment, r.reshape(-1), result.reshape(-1))
        return result


def fit_solid(model: str, tests: Iterable[Mapping[str, Any]], **options: Any) -> dict[str, Any]:
    """Parameters of an incompressible law from stresses of homogeneous tests.

    ``model`` is ``neo-hookean``, ``mooney-rivlin``, ``yeoh``, ``gent``, ``arruda-boyce``, ``polynomial:n`` or ``ogden:n``. A test is a
    dictionary:

    ============ ================================================================================
    key          meaning
    ============ ================================================================================
    ``mode``     ``uniaxial``, ``equibiaxial``, ``planar`` or ``simple_shear``
    ``stretch``  the stretches; in simple shear the amounts of shear
    ``stress``   the stresses, all in one unit
    ``measure``  ``first_piola`` (force per area of the reference; default) or ``cauchy``
    ``name``     of the test; its mode by default
    ``weight``   1 by default
    ============ ================================================================================

    Options: ``weighting`` (``largest_stress``, ``equal``), ``stability`` (``required``, ``free``), ``bounds`` ({name: (low, high)}),
    ``confidence`` (0.95), ``patience`` (200). The result is the fit as a dictionary: ``model``, ``parameters`` with ``value``,
    ``standard_error`` and ``interval``, ``tests`` with ``residuals``, ``criteria``, ``converged``, ``stable`` and more. The law itself is
    ``Solid.from_fit(json.dumps(fit), volumetric=...)``, in the unit of your stresses.
    """
    tables = []
    for test in tests:
        unknown = set(test) - {"mode", "stretch", "stress", "measure", "name", "weight"}
        if unknown:
            raise ValueError(f"a test has no {', '.join(sorted(unknown))}")
        mode = _choice("mode", test["mode"], ("uniaxial", "equibiaxial", "planar", "simple_shear"))
        stretch, stress = _array("stretch", test["stretch"]), _array("stress", test["stress"])
        if stretch.ndim != 1 or stretch.shape != stress.shape:
            raise ValueError(f"`stretch` has shape {stretch.shape}, `stress` {stress.shape}; both must be (n,)")
        if not (np.isfinite(stretch).all() and np.isfinite(stress).all()):
            raise ValueError(f"test `{test.get('name', mode)}` has stretches or stresses that are not finite")
        tables.append(
            {
                "name": test.get("name", mode),
                "table": {mode: np.column_stack([stretch, stress]).tolist()},
                "measure": test.get("measure", "first_piola"),
                "weight": float(test.get("weight", 1.0)),
            }
        )
    return _json.loads(_native.fit_solid(model, _json.dumps(tables), _options(options)))


def fit_fluid(
    fluid: str, shear_rate: Any, shear_stress: Any, start: Sequence[float], **options: Any
) -> tuple[Fluid, dict[str, Any]]:
    """Parameters of a fluid from a flow curve: the fluid, and the fit as a dictionary.

    ``fluid`` is ``newtonian``, ``power_law``, ``bingham``, ``casson``, ``eyring``, ``herschel_bulkley``, ``sisko``, ``ellis``, ``cross``,
    ``papanastasiou`` or ``carreau_yasuda``. Shear rates, 1/s, must rise; stresses are in Pa. ``start`` has the parameters, in the order of
    the table of :class:`Fluid`, from which the search starts.

    Options: ``weighting`` (``relative``, ``equal``), ``bounds`` ({name: (low, high)}), ``confidence`` (0.95), ``patience`` (200).

    >>> fluid, fit = fit_fluid("power_law", [1.0, 4.0, 9.0, 100.0], [3.0, 6.0, 9.0, 30.0], start=[1.0, 1.0])   # 3 sqrt(k)
    >>> [round(parameter["value"], 9) for parameter in fit["parameters"]]
    [3.0, 0.5]
    """
    rates, stresses = _array("shear_rate", shear_rate), _array("shear_stress", shear_stress)
    if rates.ndim != 1 or rates.shape != stresses.shape:
        raise ValueError(f"`shear_rate` has shape {rates.shape}, `shear_stress` {stresses.shape}; both must be (n,)")
    rows = np.column_stack([rates, stresses]).tolist()
    fit = _json.loads(_native.fit_fluid(fluid, rows, [float(x) for x in start], _options(options)))
    return Fluid.from_json(_json.dumps(fit.pop("fluid"))), fit


def _options(options: Mapping[str, Any]) -> str:
    written = dict(options)
    if "bounds" in written:
        written["bounds"] = [[name, [float(x) for x in bounds]] for name, bounds in dict(written["bounds"]).items()]
    return _json.dumps(written)


class Run:
    """The record of a scene.

    =================== ======================= =====================================================
    attribute           shape                   meaning
    =================== ======================= =====================================================
    names               (bodies,)               names of the bodies
    t                   (instants,)             time, s
    positions           (instants, bodies, 3)   m
    velocities          (instants, bodies, 3)   m/s; ``None`` for a mechanism
    coordinate_names    (coordinates,)          of a mechanism
    coordinates         (instants, 2 m)         coordinates and then their rates; ``None`` unless a mechanism
    energy_times        (samples,)              s
    energy              (samples,)              kinetic and potential energy, J
    summary             dictionary              status, method with its reason, steps, drifts, errors
    =================== ======================= =====================================================
    """

    __slots__ = (
        "coordinate_names",
        "coordinates",
        "energy",
        "energy_times",
        "names",
        "positions",
        "summary",
        "t",
        "velocities",
    )

    def __init__(self, record: Mapping[str, Any]) -> None:
        for name in Run.__slots__:
            setattr(self, name, record.get(name))
        self.summary = _json.loads(record["summary"])

    def __repr__(self) -> str:
        return f"Run({self.summary['name']!r}, {self.summary['status']}, {len(self.t)} instants)"


def run_scene(text: str) -> Run:
    """Runs a scene of motion written in TOML and returns its record.

    The format is that of the program ``piola``; mistakes are a ``ValueError`` that lists all of them with line and column. A run that
    fails on its way is returned as far as it came: see ``summary["status"]``. Studies (scenes without ``[time]``) are refused.
    """
    if not hasattr(_native, "run_scene"):
        raise NotImplementedError("this package was built without the feature `scenes`")
    return Run(_native.run_scene(text))
