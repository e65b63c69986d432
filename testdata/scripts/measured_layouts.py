#!/usr/bin/env python3
"""Writes data/layouts: ten measured tables in ten layouts of instruments and spreadsheets.

    measured_layouts.py SOURCE data/layouts

SOURCE holds the distributed tables (data/layouts/README.md names them). Numbers are those of the source; where a layout has another
unit, they are converted exactly and rounded to 12 digits.
"""
import csv
import pathlib
import sys

source, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
out.mkdir(parents=True, exist_ok=True)


def rows(name, delimiter=","):
    lines = [line for line in open(source / name, encoding="utf-8") if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter=delimiter))


def comma(text):
    return text.replace(".", ",")


def write(name, lines, end="\n", encoding="utf-8"):
    (out / name).write_bytes((end.join(lines) + end).encode(encoding))


cellulose = rows("rheology/ethylcellulose_flow.csv")


def of(percent):
    return [row for row in cellulose if row["conc"] == percent]


# 1. A rheometer's export: preamble, units in a line of their own, decimal commas, byte-order mark, CRLF.
lines = ["Sample;ethyl cellulose 4 %", "Measuring system;cone and plate, 1 degree", "Temperature;25 °C", "",
         "Point;Shear Rate;Shear Stress;Viscosity;Speed;Torque", ";[1/s];[Pa];[mPa·s];[1/min];[µNm]"]
for k, row in enumerate(of("4"), 1):
    viscosity = f"{1000 * float(row['viscosity_Pa_s']):.12g}"
    lines.append(";".join([str(k)] + [comma(x) for x in (row["shear_rate_1_s"], row["shear_stress_Pa"], viscosity,
                                                          row["speed_rpm"], row["torque_uNm"])]))
write("rheometer-export.csv", lines, "\r\n", "utf-8-sig")

# 2. Tabs, viscosity instead of stress, no units.
lines = ["Shear Rate\tViscosity"] + [f"{r['Shear Rate']}\t{r['Viscosity']}" for r in rows("rheology/cnf_hydrogel_flow.csv", "\t")]
write("viscosities.txt", lines)

# 3. Several samples in one table, units in the names; rows of one are chosen.
lines = [",".join(cellulose[0])] + [",".join(row.values()) for row in cellulose]
write("nine-concentrations.csv", lines)

# 4. Falling rates, the response first, units after a stroke.
emulsion = rows("rheology/emulsion_phi0.74_flow.csv")
lines = ["Stress / Pa,Shear Rate / s-1"] + [f"{row['Stress']},{row['Shear Rate']}" for row in reversed(emulsion)]
write("falling-rates.csv", lines)

# 5. Speeds and torques of a cone with its geometry in words, extra columns.
lines = ["# Cone angle = 1 °", "# Diameter = 25 mm", "Time [s],Torque (µN m),Speed (rpm)"]
lines += [f"{10 * k},{row['torque_uNm']},{row['speed_rpm']}" for k, row in enumerate(of("6"), 1)]
write("cone-torques.csv", lines)

# 6. Viscosities in centipoise.
lines = ["shear rate (1/s), viscosity (cP)"]
lines += [f"{row['shear_rate_1_s']}, {1000 * float(row['viscosity_Pa_s']):.12g}" for row in of("8")]
write("centipoise.csv", lines)

# 7. UTF-16 with tabs, after lines of an instrument.
emulsion = rows("rheology/emulsion_phi0.70_flow.csv")
lines = ["Project:\temulsions", "Test:\tflow curve", "", "Shear Stress\tShear Rate", "[Pa]\t[1/s]"]
lines += [f"{row['Stress']}\t{row['Shear Rate']}" for row in emulsion]
write("utf16.txt", lines, "\r\n", "utf-16")

# 8. A tensile tester: engineering strain in percent, stress in N/mm², a specimen for each mode, decimal commas.
names = {"UT": "uniaxial", "ET": "equibiaxial", "PS": "planar"}
lines = ["Specimen;Test type;Strain [%];Stress [N/mm²]"]
for row in rows("hyperelastic/Treloar_1944.csv"):
    strain = f"{100 * (float(row['F11']) - 1):.12g}"
    lines.append(";".join([row["mode"] + "-1", names[row["mode"]], comma(strain), comma(row["S11"])]))
write("percent-strain.csv", lines, "\r\n")

# 9. Sheets pulled unequally both ways: principal stretches and engineering stresses.
lines = ["lambda1,lambda2,P1,P2"]
for row in rows("hyperelastic/Katashima_2012.csv"):
    if row["mode"] == "BT":
        lines.append(",".join(row[key] for key in ("F11", "F22", "S11", "S22")))
write("unequal-stretches.csv", lines)

# 10. One mode in a comment, true stresses, the stress before the stretch.
lines = ["# Mode: equibiaxial", "# unit: MPa", "true stress,stretch ratio"]
for row in rows("hyperelastic/Kawabata_1981.csv"):
    if row["mode"] == "ET":
        lines.append(f"{float(row['S11']) * float(row['F11']):.12g},{row['F11']}")
write("true-stress.csv", lines)
