"""Kinematics and dynamics of two MJCF models as MuJoCo computes them, in the coordinates of piola.

The package `mujoco` (PyPI, 4.0.0) reads the models beside the data. A free joint has in piola the quaternion before the position,
and the velocity of the origin in the axes of the body, behind the angular velocity:

    v_mujoco = T v        M = T' M_mujoco T        b = T' (b_mujoco + M_mujoco dT/dt v)

    python3 testdata/scripts/mujoco_models.py > testdata/reference/mujoco_models.json
"""

import json
import pathlib

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).parent.parent / "reference"
FREE = mujoco.mjtJoint.mjJNT_FREE


def to_piola(model, qpos):
    out = np.array(qpos)
    for j in range(model.njnt):
        if model.jnt_type[j] == FREE:
            a = model.jnt_qposadr[j]
            out[a : a + 7] = np.concatenate([qpos[a + 3 : a + 7], qpos[a : a + 3]])
    return out


def velocity_map(model, qpos, v):
    """T and dT/dt v."""
    turn, rate = np.eye(model.nv), np.zeros(model.nv)
    for j in range(model.njnt):
        if model.jnt_type[j] != FREE:
            continue
        a, d = model.jnt_qposadr[j], model.jnt_dofadr[j]
        r = np.zeros(9)
        mujoco.mju_quat2Mat(r, qpos[a + 3 : a + 7])
        r = r.reshape(3, 3)
        turn[d : d + 6, d : d + 6] = np.block([[np.zeros((3, 3)), r], [np.eye(3), np.zeros((3, 3))]])
        rate[d : d + 3] = r @ np.cross(v[d : d + 3], v[d + 3 : d + 6])
    return turn, rate


def model_data(name, states):
    model = mujoco.MjModel.from_xml_path(str(HERE / name))
    data = mujoco.MjData(model)
    rng = np.random.default_rng(7)
    out = {"file": name, "home": to_piola(model, model.qpos0).tolist(), "states": []}
    for _ in range(states):
        qpos = np.array(model.qpos0)
        mujoco.mj_integratePos(model, qpos, rng.uniform(-0.8, 0.8, model.nv), 1.0)
        v = rng.uniform(-1.5, 1.5, model.nv)
        turn, rate = velocity_map(model, qpos, v)
        data.qpos[:], data.qvel[:] = qpos, turn @ v
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        bias = turn.T @ (data.qfrc_bias + mass @ rate)
        springs = turn.T @ data.qfrc_passive
        positions, rotations = data.xpos[1:].copy(), data.xmat[1:].reshape(-1, 3, 3).copy()
        data.qvel[:] = 0.0
        mujoco.mj_forward(model, data)
        gravity = turn.T @ data.qfrc_bias
        out["states"].append(
            {
                "q": to_piola(model, qpos).tolist(),
                "v": v.tolist(),
                "mass_matrix": (turn.T @ mass @ turn).tolist(),
                "bias": bias.tolist(),
                "gravity": gravity.tolist(),
                "springs_and_dampers": springs.tolist(),
                "positions": positions.tolist(),
                "rotations": rotations.tolist(),
            }
        )
    # Rows of the closures in the configuration of the file.
    data.qpos[:], data.qvel[:] = model.qpos0, 0.0
    mujoco.mj_forward(model, data)
    jacobian = np.array(data.efc_J).reshape(data.nefc, model.nv) if data.nefc else np.zeros((0, model.nv))
    equality = [i for i in range(data.nefc) if data.efc_type[i] == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    out["closure_rows"] = jacobian[equality].tolist()
    out["closure_residuals"] = [float(data.efc_pos[i]) for i in equality]
    return out


print(
    json.dumps(
        {
            "provenance": f"testdata/scripts/mujoco_models.py, MuJoCo {mujoco.__version__}, double precision",
            "models": [model_data("mjcf_limbs.xml", 3), model_data("mjcf_linkage.xml", 3)],
        },
        indent=1,
    )
)
