// Times Pinocchio on the trees of `cargo run --release -p piola-multibody --example timing`; prints one table.
//
//     python3 -m venv pinocchio && pinocchio/bin/pip install pin
//     P=$(echo pinocchio/lib/python3*/site-packages/cmeel.prefix)
//     g++ -O3 -DNDEBUG -std=c++17 -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
//         -DBOOST_FUSION_INVOKE_MAX_ARITY=12 \
//         -I $P/include -I $P/include/eigen3 benches/peers/multibody.cpp -o times -L $P/lib -lpinocchio_default -Wl,-rpath,$P/lib
//     taskset -c 1 ./times
//
// The least of thirty measurements. Inverse and forward dynamics: nanoseconds a joint; the others: nanoseconds a call.

#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using namespace pinocchio;

// The least nanoseconds of a call.
template <class Call>
double least(Call call) {
    double best = 1e300;
    long repeats = 1;
    for (int k = 0; k < 30; k++) {
        const auto start = std::chrono::steady_clock::now();
        for (long i = 0; i < repeats; i++) call();
        const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = std::min(best, time / repeats);
        if (time < 2e-3) repeats *= 2;
    }
    return best * 1e9;
}

// Rods of 1 kg and 1 m, axes y and x in turn.
Model chain(int links) {
    Model model;
    JointIndex parent = 0;
    const Eigen::Matrix3d inertia = Eigen::Vector3d(0.084, 0.084, 0.0013).asDiagonal();
    for (int i = 0; i < links; i++) {
        SE3 place = SE3::Identity();
        if (0 < i) place.translation() = Eigen::Vector3d(0, 0, -1);
        const std::string name = "j" + std::to_string(i);
        const JointIndex joint = i % 2 == 0 ? model.addJoint(parent, JointModelRY(), place, name)
                                            : model.addJoint(parent, JointModelRX(), place, name);
        model.appendBodyToJoint(joint, Inertia(1.0, Eigen::Vector3d(0, 0, -0.5), inertia), SE3::Identity());
        parent = joint;
    }
    return model;
}

// The arm UR5: place, axis (2: z, else y), pitch, moments of inertia across and along, mass, place of the centre along z.
Model ur5() {
    struct Row {
        double x, y, z;
        int axis;
        double pitch, across, along, mass, centre;
    };
    const double quarter = M_PI / 2;
    const Row rows[] = {
        {0, 0, 0.089159, 2, 0, 0.010267495893, 0.00666, 3.7, 0},
        {0, 0.13585, 0, 1, quarter, 0.22689067591, 0.0151074, 8.393, 0.28},
        {0, -0.1197, 0.425, 1, 0, 0.049443313556, 0.004095, 2.275, 0.25},
        {0, 0, 0.39225, 1, quarter, 0.111172755531, 0.21942, 1.219, 0},
        {0, 0.093, 0, 2, 0, 0.111172755531, 0.21942, 1.219, 0},
        {0, 0, 0.09465, 1, 0, 0.0171364731454, 0.033822, 0.1879, 0},
    };
    Model model;
    JointIndex parent = 0;
    for (int i = 0; i < 6; i++) {
        const Row& row = rows[i];
        SE3 place = SE3::Identity();
        place.translation() = Eigen::Vector3d(row.x, row.y, row.z);
        place.rotation() = Eigen::AngleAxisd(row.pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
        const std::string name = "j" + std::to_string(i);
        const JointIndex joint = row.axis == 2 ? model.addJoint(parent, JointModelRZ(), place, name)
                                               : model.addJoint(parent, JointModelRY(), place, name);
        const Eigen::Matrix3d inertia = Eigen::Vector3d(row.across, row.across, row.along).asDiagonal();
        model.appendBodyToJoint(joint, Inertia(row.mass, Eigen::Vector3d(0, 0, row.centre), inertia), SE3::Identity());
        parent = joint;
    }
    return model;
}

// A tree of equal rods, as `robot` in crates/multibody/tests/it/trees.rs: of each its parent, from 1, and its joint.
using Joints = std::vector<std::pair<int, char>>;

int limb(Joints& joints, int parent, const std::string& letters) {
    for (const char letter : letters) {
        joints.emplace_back(parent, letter);
        parent = static_cast<int>(joints.size());
    }
    return parent;
}

Model robot(const Joints& joints) {
    Model model;
    const Eigen::Matrix3d inertia = Eigen::Vector3d(0.084, 0.084, 0.0013).asDiagonal();
    for (std::size_t i = 0; i < joints.size(); i++) {
        const auto [parent, letter] = joints[i];
        SE3 place = SE3::Identity();
        if (0 < parent) place.translation() = Eigen::Vector3d(0.1, 0.05, -0.3);
        const std::string name = "j" + std::to_string(i);
        JointIndex joint = 0;
        switch (letter) {
            case 'x': joint = model.addJoint(parent, JointModelRX(), place, name); break;
            case 'y': joint = model.addJoint(parent, JointModelRY(), place, name); break;
            case 'z': joint = model.addJoint(parent, JointModelRZ(), place, name); break;
            case 's': joint = model.addJoint(parent, JointModelPY(), place, name); break;
            default: joint = model.addJoint(parent, JointModelFreeFlyer(), place, name);
        }
        model.appendBodyToJoint(joint, Inertia(1.0, Eigen::Vector3d(0, 0, -0.5), inertia), SE3::Identity());
    }
    return model;
}

Model gripper_arm() {
    Joints joints;
    const int hand = limb(joints, 0, "zyzyzyz");
    limb(joints, hand, "s");
    limb(joints, hand, "s");
    return robot(joints);
}

Model quadruped() {
    Joints joints;
    const int trunk = limb(joints, 0, "f");
    for (int i = 0; i < 4; i++) limb(joints, trunk, "xyy");
    return robot(joints);
}

Model humanoid() {
    Joints joints;
    const int pelvis = limb(joints, 0, "f");
    for (int i = 0; i < 2; i++) limb(joints, pelvis, "zxyyyx");
    const int torso = limb(joints, pelvis, "zy");
    limb(joints, torso, "zy");
    for (int i = 0; i < 2; i++) {
        const int hand = limb(joints, torso, "yxzyzyx");
        limb(joints, hand, "yy");
        limb(joints, hand, "yy");
        limb(joints, hand, "zyy");
    }
    return robot(joints);
}

void row(const std::string& name, const Model& model) {
    Data data(model);
    Eigen::VectorXd q(model.nq), v(model.nv);
    for (int i = 0; i < model.nq; i++) q[i] = std::sin(i);
    normalize(model, q);
    for (int i = 0; i < model.nv; i++) v[i] = std::cos(1.3 * i);
    const Eigen::VectorXd a = v;
    const double inverse = least([&] { rnea(model, data, q, v, a); }) / model.nv;
    const double forward = std::min(least([&] { aba(model, data, q, v, a, Convention::LOCAL); }),
                                    least([&] { aba(model, data, q, v, a, Convention::WORLD); })) /
                           model.nv;
    const double mass = least([&] { crba(model, data, q, Convention::WORLD); });
    const double by_forces = least([&] { computeRNEADerivatives(model, data, q, v, a); });
    const double by_state = least([&] { computeABADerivatives(model, data, q, v, a); });
    std::printf("| %s | %.1f | %.1f | %.0f | %.0f | %.0f |\n", name.c_str(), inverse, forward, mass, by_forces, by_state);
}

int main() {
    std::printf("| tree | inverse | forward | M | d tau | d acceleration |\n|---|---|---|---|---|---|\n");
    row("ur5", ur5());
    row("arm with gripper, nv 9", gripper_arm());
    row("quadruped, nv 18", quadruped());
    row("humanoid, nv 50", humanoid());
    for (int links : {10, 30, 100, 300}) row("chain " + std::to_string(links), chain(links));
}
