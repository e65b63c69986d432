/* C interface of Piola. Written by `cargo xtask header` from the sources of piola-ffi. */
/* Link with -lpiola_ffi. Every function checks its arguments; see docs/how-to/other-languages.md. */

#ifndef PIOLA_H
#define PIOLA_H

#include <stddef.h>
#include <stdint.h>

// The result of a call.
typedef enum {
  // Everything was computed.
  PIOLA_STATUS_OK = 0,
  // A pointer that must lead somewhere is null or does not lead to a number's boundary, or an output overlaps another array.
  PIOLA_STATUS_BAD_POINTER = 1,
  // An array has another length than the arrays beside it ask for.
  PIOLA_STATUS_WRONG_LENGTH = 2,
  // A number that was given is infinite or NaN.
  PIOLA_STATUS_NOT_FINITE = 3,
  // A choice has a number or a name that it does not have.
  PIOLA_STATUS_UNKNOWN_CHOICE = 4,
  // A text describes no law, or its parameters violate a condition.
  PIOLA_STATUS_BAD_LAW = 5,
  // The law has no answer at some points: theirs are NaN, all others are written.
  PIOLA_STATUS_BAD_POINTS = 6,
  // A flow has no answer.
  PIOLA_STATUS_BAD_FLOW = 7,
  // A fault of this library.
  PIOLA_STATUS_FAULT = 8,
} PiolaStatus;

// A measure of stress.
typedef enum {
  // Cauchy stress T, Pa.
  PIOLA_STRESS_CAUCHY = 0,
  // First Piola-Kirchhoff stress P, Pa.
  PIOLA_STRESS_FIRST_PIOLA = 1,
  // Second Piola-Kirchhoff stress S, Pa.
  PIOLA_STRESS_SECOND_PIOLA = 2,
} PiolaStress;

// A tangent.
typedef enum {
  // dP/dF, Pa: 81 numbers a point, row 3 i + A, column 3 j + B.
  PIOLA_TANGENT_FIRST_PIOLA = 0,
  // dS/dE, Pa: 36 numbers a point.
  PIOLA_TANGENT_MATERIAL = 1,
  // Tangent of Truesdell's rate of T, Pa: 36 numbers a point.
  PIOLA_TANGENT_TRUESDELL = 2,
  // Tangent of Jaumann's rate of the Kirchhoff stress, over J, Pa (DDSDDE of Abaqus): 36 numbers a point.
  PIOLA_TANGENT_JAUMANN = 3,
} PiolaTangent;

// The order of the six pairs of indices in tangents of 36 numbers, which multiply engineering shears.
typedef enum {
  // 11, 22, 33, 12, 23, 13.
  PIOLA_VOIGT_PIOLA = 0,
  // 11, 22, 33, 12, 13, 23.
  PIOLA_VOIGT_ABAQUS = 1,
  // 11, 22, 33, 23, 13, 12.
  PIOLA_VOIGT_CLASSICAL = 2,
} PiolaVoigt;

// A viscometric function.
typedef enum {
  // Shear stress, Pa, of shear rates, 1/s.
  PIOLA_VISCOMETRIC_SHEAR_STRESS = 0,
  // Viscosity, Pa s, of shear rates, 1/s.
  PIOLA_VISCOMETRIC_VISCOSITY = 1,
  // N1 = T22 - T11, Pa, of shear rates, 1/s; direction 1 is that of the gradient, 2 that of the flow.
  PIOLA_VISCOMETRIC_FIRST_NORMAL_STRESS_DIFFERENCE = 2,
  // N2 = T11 - T33, Pa, of shear rates, 1/s.
  PIOLA_VISCOMETRIC_SECOND_NORMAL_STRESS_DIFFERENCE = 3,
  // Shear rate, 1/s, of shear stresses, Pa.
  PIOLA_VISCOMETRIC_SHEAR_RATE = 4,
} PiolaViscometric;

#if defined(PIOLA_HISTORY)
// How the states of n points stand in memory; S is the number of internal variables.
typedef enum {
  // The state of a point in one piece: number k of point i at S i + k.
  PIOLA_LAYOUT_ROWS = 0,
  // Each internal variable of all points in one piece: number k of point i at n k + i.
  PIOLA_LAYOUT_COMPONENTS = 1,
} PiolaLayout;
#endif

// A fluid. Made by `piola_fluid_from_*`, freed by `piola_fluid_free`.
typedef struct PiolaFluid PiolaFluid;

#if defined(PIOLA_HISTORY)
// A law with history. Made by `piola_history_from_*`, freed by `piola_history_free`.
typedef struct PiolaHistory PiolaHistory;
#endif

// A law of a solid. Made by `piola_solid_from_*`, freed by `piola_solid_free`.
typedef struct PiolaSolid PiolaSolid;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Message of the last call of this thread that failed; empty if none did.
//
// It ends with a zero byte and stays valid until another call of the same thread fails.
const char *piola_last_error(void);

// Copies the message of the last failed call of this thread, padded with blanks as Fortran does; returns its length.
size_t piola_last_error_padded(char *text, size_t length);

// Version of the library, such as `0.1.0`.
const char *piola_version(void);

// Makes a law from JSON, such as `{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1e6, "shear_modulus": 2e6}`.
PiolaStatus piola_solid_from_json(const char *json,
                                  PiolaSolid **made);

// Makes the law of a fit from the text of its `summary.json`.
//
// `model` chooses one of its laws, such as `yeoh`; a null pointer chooses the best by `aicc`. `volumetric` is the energy of the
// change of volume in JSON, such as `{"law": "quadratic", "bulk_modulus": 2e9}`; with a null pointer the law is incompressible. Parameters
// are converted from the `stress_unit` of the summary to Pa.
PiolaStatus piola_solid_from_fit(const char *summary,
                                 const char *model,
                                 const char *volumetric,
                                 PiolaSolid **made);

// Makes a law from its name, such as `compressible-gent-simo_taylor`, and its parameters in the order of the reference.
PiolaStatus piola_solid_from_values(const char *name, const double *values, size_t count, PiolaSolid **made);

// Makes a law from its name and `count` parameters by name, in any order.
PiolaStatus piola_solid_from_names(const char *name,
                                   const char *const *names,
                                   const double *values,
                                   size_t count,
                                   PiolaSolid **made);

// Frees a law; a null pointer is no fault.
void piola_solid_free(PiolaSolid *solid);

// Stress at n points.
//
// `stress` is a `PiolaStress`. `f` has the deformation gradients, nine numbers a point by rows; `out` gets the stresses, Pa, nine
// numbers a point by rows. Both lengths are 9 n numbers. After `PIOLA_STATUS_BAD_POINTS` the stresses of bad points are NaN, and all
// others are written.
PiolaStatus piola_stress(const PiolaSolid *solid,
                         int32_t stress,
                         const double *f,
                         size_t f_length,
                         double *out,
                         size_t out_length);

// Strain energy at n points, J/m^3 of the reference, less that of the undeformed body.
//
// `f` has the deformation gradients, 9 n numbers by rows; `out` gets n numbers. After `PIOLA_STATUS_BAD_POINTS` the energies of bad
// points are NaN, and all others are written.
PiolaStatus piola_energy(const PiolaSolid *solid,
                         const double *f,
                         size_t f_length,
                         double *out,
                         size_t out_length);

// Tangent at n points.
//
// `tangent` is a `PiolaTangent`, `voigt` a `PiolaVoigt`. `out` gets 81 or 36 numbers a point, Pa, by rows.
PiolaStatus piola_tangent(const PiolaSolid *solid,
                          int32_t tangent,
                          int32_t voigt,
                          const double *f,
                          size_t f_length,
                          double *out,
                          size_t out_length);

// Stress and tangent at n points, the law evaluated once for both.
PiolaStatus piola_stress_and_tangent(const PiolaSolid *solid,
                                     int32_t stress,
                                     int32_t tangent,
                                     int32_t voigt,
                                     const double *f,
                                     size_t f_length,
                                     double *stresses,
                                     size_t stresses_length,
                                     double *tangents,
                                     size_t tangents_length);

// Makes a fluid from JSON, such as `{"fluid": "bingham", "yield_stress": 3.0, "plastic_viscosity": 0.5}`.
PiolaStatus piola_fluid_from_json(const char *json, PiolaFluid **made);

// Makes a fluid from its name, such as `bingham`, and `count` parameters by name, in any order.
PiolaStatus piola_fluid_from_names(const char *name,
                                   const char *const *names,
                                   const double *values,
                                   size_t count,
                                   PiolaFluid **made);

// Frees a fluid; a null pointer is no fault.
void piola_fluid_free(PiolaFluid *fluid);

// A viscometric function at each entry; `function` is a `PiolaViscometric`.
PiolaStatus piola_viscometric(const PiolaFluid *fluid,
                              int32_t function,
                              const double *entries,
                              size_t entries_length,
                              double *out,
                              size_t out_length);

// Discharge, m^3/s, along a pipe of this radius, m, under a pressure gradient -dp/dz, Pa/m; with its error bound unless `error` is null.
PiolaStatus piola_pipe_discharge(const PiolaFluid *fluid,
                                 double radius,
                                 double pressure_gradient,
                                 double *value,
                                 double *error);

// Pressure gradient, Pa/m, that drives a discharge, m^3/s, along a pipe; with its error bound unless `error` is null.
PiolaStatus piola_pipe_pressure_gradient(const PiolaFluid *fluid,
                                         double radius,
                                         double discharge,
                                         double *value,
                                         double *error);

// Velocities, m/s, along a pipe at distances from its axis, m.
PiolaStatus piola_pipe_velocities(const PiolaFluid *fluid,
                                  double radius,
                                  double pressure_gradient,
                                  const double *distances,
                                  size_t distances_length,
                                  double *out,
                                  size_t out_length);

// Difference of the angular velocities, rad/s, of coaxial cylinders of these radii, m, under a moment per length, N m/m.
PiolaStatus piola_couette_speed_difference(const PiolaFluid *fluid,
                                           double inner_radius,
                                           double outer_radius,
                                           double moment,
                                           double *value,
                                           double *error);

// Moment per length, N m/m, that turns coaxial cylinders with this difference of angular velocities, rad/s.
PiolaStatus piola_couette_moment(const PiolaFluid *fluid,
                                 double inner_radius,
                                 double outer_radius,
                                 double speed_difference,
                                 double *value,
                                 double *error);

// STRESS, DDSDDE and STATEV of Abaqus at one point; see `fortran/umat.f`.
//
// `name` has `name_length` characters: a law with its parameters in `properties`, or the name of a file in the folder
// `PIOLA_MATERIALS`. `from` and `to` are DFGRD0 and DFGRD1, nine numbers by columns; `dt` is DTIME. `temperature` is that at the end,
// TEMP + DTEMP; the law `thermal` takes it in the place of its state, and no other law uses it. `state` has `state_length` numbers, zeros for
// the body as it was made; an elastic law leaves any state alone. `stress` gets NTENS = `direct` + `shear` numbers, `tangent` NTENS^2 by
// columns.
PiolaStatus piola_umat(const char *name,
                       size_t name_length,
                       const double *properties,
                       size_t properties_length,
                       size_t direct,
                       size_t shear,
                       const double *from,
                       const double *to,
                       double dt,
                       double temperature,
                       double *state,
                       size_t state_length,
                       double *stress,
                       double *tangent);

// Corotated stresses and states of Abaqus/Explicit; see `fortran/vumat.f`. No tangent is computed.
//
// `before` and `after` have n (`direct` + `shear`) numbers, each component an array: 11, 22, 33, 12, 23, 13; with a null pointer
// the body is undeformed before. `added` is added to the diagonal of `after`: 0 for stretches, 1 for small strains. `temperatures` has n
// numbers, tempNew, which the law `thermal` takes as its new states. Without temperatures `thermal` keeps its states, and a state of zero
// becomes the reference temperature. `old` and `new_states`
// have n `state_length` numbers, each variable an array; a state of zeros is that of the body as it was made, and states of elastic laws are
// copied. `stresses` gets as many numbers as `after` has. Outputs that overlap inputs or one another are refused.
PiolaStatus piola_vumat(const char *name,
                        size_t name_length,
                        const double *properties,
                        size_t properties_length,
                        size_t points,
                        size_t direct,
                        size_t shear,
                        const double *before,
                        const double *after,
                        double added,
                        double dt,
                        const double *temperatures,
                        size_t temperatures_length,
                        const double *old,
                        double *new_states,
                        size_t state_length,
                        double *stresses);

#if defined(PIOLA_HISTORY)
// Makes a law with history from JSON, such as `{"law": "in_series", "first": {...}, "second": {...}, "viscosity": 0.5}`.
PiolaStatus piola_history_from_json(const char *json,
                                    PiolaHistory **made);
#endif

#if defined(PIOLA_HISTORY)
// Makes the law of a fit of laws with history from the text of its `summary.json`.
//
// `model` chooses one of its laws, such as `reese-govindjee`; a null pointer chooses the best by `aicc`. Parameters are converted from the
// `stress_unit` of the summary to Pa.
PiolaStatus piola_history_from_fit(const char *summary,
                                   const char *model,
                                   PiolaHistory **made);
#endif

#if defined(PIOLA_HISTORY)
// Makes a law with history from its name, such as `mullins-neo_hookean-lame`, and its parameters in the order of the reference.
PiolaStatus piola_history_from_values(const char *name,
                                      const double *values,
                                      size_t count,
                                      PiolaHistory **made);
#endif

#if defined(PIOLA_HISTORY)
// Makes a law with history from its name and `count` parameters by name, such as `overstress.shear_modulus`, in any order.
PiolaStatus piola_history_from_names(const char *name,
                                     const char *const *names,
                                     const double *values,
                                     size_t count,
                                     PiolaHistory **made);
#endif

#if defined(PIOLA_HISTORY)
// Frees a law with history; a null pointer is no fault.
void piola_history_free(PiolaHistory *history);
#endif

#if defined(PIOLA_HISTORY)
// The number of internal variables of a law.
PiolaStatus piola_history_state_length(const PiolaHistory *history, size_t *length);
#endif

#if defined(PIOLA_HISTORY)
// The number of internal variables of the law with this name, NSTATV of Abaqus: that of a law, such as `kinematic-hencky-lame-hencky-lame`,
// or of a file in the folder `PIOLA_MATERIALS`; 0 of an elastic law.
PiolaStatus piola_history_state_length_of(const char *name,
                                          size_t *length);
#endif

#if defined(PIOLA_HISTORY)
// Writes the states of n points of the body as it was made; `layout` is a `PiolaLayout`.
PiolaStatus piola_history_initial_states(const PiolaHistory *history,
                                         int32_t layout,
                                         double *states,
                                         size_t states_length);
#endif

#if defined(PIOLA_HISTORY)
// One increment at n points: stresses, consistent tangents and new states.
//
// `stress` is a `PiolaStress`, `tangent` a `PiolaTangent`, `voigt` a `PiolaVoigt`, `layout` a `PiolaLayout`. The deformation gradients
// `from` and `to`, 9 n numbers by rows, are those at the start and the end; the increment takes `dt` s. `tolerance` bounds the estimated
// error of the internal variables; with 0 the increment is one implicit step. `before` and `after` have n states. Outputs that overlap
// inputs or one another are refused: `after` is other memory than `before`.
// `tangents` gets 81 or 36 numbers a point, by rows, without major symmetry in general. With a null pointer and the length 0 no tangent is
// computed.
//
// After `PIOLA_STATUS_BAD_POINTS` stresses and tangents of the points that failed are NaN and their new states those before; the message
// names the first of them, and the share of the increment up to which an update was found. All others are advanced.
PiolaStatus piola_history_advance(const PiolaHistory *history,
                                  int32_t stress,
                                  int32_t tangent,
                                  int32_t voigt,
                                  int32_t layout,
                                  double dt,
                                  double tolerance,
                                  const double *from,
                                  const double *to,
                                  size_t f_length,
                                  const double *before,
                                  double *after,
                                  size_t states_length,
                                  double *stresses,
                                  size_t stresses_length,
                                  double *tangents,
                                  size_t tangents_length);
#endif

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PIOLA_H */
