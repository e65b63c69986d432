/* Checks of the C interface: closed forms, messages, and what is refused. */
#include "piola.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int checks = 0, failures = 0;

static void check(int holds, const char *what) {
    ++checks;
    if (!holds) {
        ++failures;
        printf("FAILED: %s (last error: %s)\n", what, piola_last_error());
    }
}

static int is_near(double found, double expected) {
    return fabs(found - expected) <= 1e-14 * fabs(expected);
}

int main(void) {
    const double pi = acos(-1.0);
    double f[2 * 9] = {2, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    double stress[2 * 9], tangent[2 * 36];
    PiolaSolid *solid = NULL, *none = NULL;
    PiolaFluid *fluid = NULL;

    check(strlen(piola_version()) >= 5, "version");
    check(strlen(piola_last_error()) == 0, "no message before a failure");

    /* S = lambda tr E 1 + 2 mu E with lambda = 1, mu = 2, E11 = 3/2 */
    const double values[] = {1.0, 2.0};
    check(piola_solid_from_values("saint_venant_kirchhoff", values, 2, &solid) == PIOLA_STATUS_OK, "law");
    check(piola_stress(solid, PIOLA_STRESS_CAUCHY, f, 18, stress, 18) == PIOLA_STATUS_OK, "Cauchy stress");
    check(stress[0] == 15.0 && stress[9] == 0.0, "T11 = F11^2 (lambda + 2 mu) E11/J");
    double energy[2];
    check(piola_energy(solid, f, 18, energy, 2) == PIOLA_STATUS_OK && energy[0] == 5.625 && energy[1] == 0.0,
          "W = (lambda + 2 mu) E11^2/2");
    check(piola_stress(solid, PIOLA_STRESS_FIRST_PIOLA, f, 18, stress, 18) == PIOLA_STATUS_OK && stress[0] == 15.0,
          "P11 = F11 S11");
    check(piola_stress(solid, PIOLA_STRESS_SECOND_PIOLA, f, 18, stress, 18) == PIOLA_STATUS_OK && stress[0] == 7.5,
          "S11");
    check(piola_tangent(solid, PIOLA_TANGENT_JAUMANN, PIOLA_VOIGT_ABAQUS, f, 18, tangent, 72) == PIOLA_STATUS_OK,
          "Jaumann tangent");
    /* F11^4 (lambda + 2 mu)/J + 2 T11, and mu at rest */
    check(tangent[0] == 70.0 && tangent[36 + 21] == 2.0, "Jaumann tangent of stretch and rest");
    check(piola_stress_and_tangent(solid, PIOLA_STRESS_CAUCHY, PIOLA_TANGENT_MATERIAL, PIOLA_VOIGT_PIOLA, f, 18, stress, 18,
                                   tangent, 72) == PIOLA_STATUS_OK &&
              stress[0] == 15.0 && tangent[0] == 5.0,
          "stress and tangent together");

    f[0] = 0.0;
    check(piola_stress(solid, PIOLA_STRESS_CAUCHY, f, 18, stress, 18) == PIOLA_STATUS_BAD_POINTS && isnan(stress[0]) &&
              stress[9] == 0.0 && strstr(piola_last_error(), "1 of 2 points failed: at point 0") != NULL,
          "a bad point");
    check(piola_stress(NULL, PIOLA_STRESS_CAUCHY, f, 18, stress, 18) == PIOLA_STATUS_BAD_POINTER, "a null pointer");
    check(piola_stress(solid, 17, f, 18, stress, 18) == PIOLA_STATUS_UNKNOWN_CHOICE, "a choice that is none");
    check(piola_solid_from_json("{\"law\": \"cheese\"}", &none) == PIOLA_STATUS_BAD_LAW && none == NULL,
          "a law that is none");
    piola_solid_free(solid);

    const char *names[] = {"viscosity_coefficient"};
    const double viscosity[] = {0.5};
    double value = 0.0, error = 0.0;
    check(piola_fluid_from_names("newtonian", names, viscosity, 1, &fluid) == PIOLA_STATUS_OK, "fluid");
    check(piola_pipe_discharge(fluid, 2.0, 3.0, &value, &error) == PIOLA_STATUS_OK && fabs(value - 12 * pi) <= error,
          "pi c R^4/(8 mu)");
    check(piola_couette_moment(fluid, 1.0, 2.0, 3.0, &value, NULL) == PIOLA_STATUS_OK && is_near(value, 8 * pi),
          "moment of coaxial cylinders");
    const double rate = 4.0;
    check(piola_viscometric(fluid, PIOLA_VISCOMETRIC_SHEAR_STRESS, &rate, 1, &value, 1) == PIOLA_STATUS_OK && value == 2.0,
          "mu k");
    piola_fluid_free(fluid);

    if (failures == 0) {
        printf("all %d checks passed\n", checks);
    }
    return failures;
}
