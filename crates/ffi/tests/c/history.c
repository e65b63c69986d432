/* Checks of laws with history in C: relaxation, layouts, and what is refused. */
#define PIOLA_HISTORY
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

int main(void) {
    const double still[2 * 9] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    double sheared[2 * 9] = {1, 0.3, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    double states[2 * 9], after[2 * 9], stresses[2 * 9], tangents[2 * 36];
    size_t length = 0;
    PiolaHistory *law = NULL, *none = NULL;

    /* A neo-Hookean law at rest beside a spring that flows: mu = 1, eta = 0.5. */
    const char *name = "reese_govindjee-neo_hookean-simo_taylor-neo_hookean-simo_taylor";
    const double values[] = {1, 2, 1, 2, 0.5, 0};
    check(piola_history_from_values(name, values, 6, &law) == PIOLA_STATUS_OK, "law");
    check(piola_history_state_length(law, &length) == PIOLA_STATUS_OK && length == 9, "length of the state");
    check(piola_history_state_length_of("kinematic-hencky-lame-hencky-lame", &length) == PIOLA_STATUS_OK && length == 19,
          "length of the state by name");
    check(piola_history_initial_states(law, PIOLA_LAYOUT_COMPONENTS, states, 18) == PIOLA_STATUS_OK && states[1] == 1.0 &&
              states[2] == 0.0,
          "states of the body as it was made");
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, PIOLA_TANGENT_JAUMANN, PIOLA_VOIGT_ABAQUS, PIOLA_LAYOUT_COMPONENTS,
                                1e-9, 0.0, still, sheared, 18, states, after, 18, stresses, 18, tangents, 72) ==
              PIOLA_STATUS_OK,
          "an increment");
    check(fabs(stresses[1] - 0.6) < 1e-8 && stresses[9] == 0.0, "2 mu k");
    check(fabs(tangents[36 + 21] - 2.0) < 1e-8, "2 mu");
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, 0, 0, PIOLA_LAYOUT_COMPONENTS, 1e6, 0.0, sheared, sheared, 18, after,
                                states, 18, stresses, 18, NULL, 0) == PIOLA_STATUS_OK &&
              fabs(stresses[1] - 0.3) < 1e-6,
          "mu k of the block that is held");
    sheared[0] = 0.0;
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, 0, 0, PIOLA_LAYOUT_COMPONENTS, 1.0, 0.0, still, sheared, 18, states,
                                after, 18, stresses, 18, NULL, 0) == PIOLA_STATUS_BAD_POINTS &&
              isnan(stresses[0]) && stresses[9] == 0.0 && strstr(piola_last_error(), "1 of 2 points failed: at point 0"),
          "a point that fails");
    check(after[0] == states[0], "its state");
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, 0, 0, PIOLA_LAYOUT_ROWS, 1.0, 0.0, still, sheared, 18, states, after,
                                17, stresses, 18, NULL, 0) == PIOLA_STATUS_WRONG_LENGTH,
          "a wrong length");
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, 0, 0, PIOLA_LAYOUT_ROWS, 1.0, 0.0, still, still, 18, states, states,
                                18, stresses, 18, NULL, 0) == PIOLA_STATUS_BAD_POINTER &&
              strstr(piola_last_error(), "`after` overlaps `before`"),
          "new states in the memory of the old ones");
    check(piola_history_advance(law, PIOLA_STRESS_CAUCHY, 0, 0, 2, 1.0, 0.0, still, still, 18, states, after, 18, stresses, 18,
                                NULL, 0) == PIOLA_STATUS_UNKNOWN_CHOICE,
          "a layout that is none");
    check(piola_history_advance(NULL, PIOLA_STRESS_CAUCHY, 0, 0, 0, 1.0, 0.0, still, still, 18, states, after, 18, stresses, 18,
                                NULL, 0) == PIOLA_STATUS_BAD_POINTER,
          "a null pointer");
    check(piola_history_from_json("{\"law\": \"cheese\"}", &none) == PIOLA_STATUS_BAD_LAW && none == NULL,
          "a law that is none");
    piola_history_free(law);
    piola_history_free(NULL);

    if (failures == 0) {
        printf("all %d checks passed\n", checks);
    }
    return failures;
}
