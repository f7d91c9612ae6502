// SPDX-License-Identifier: MIT
/// \file
/// What the solver reports about a step or an equilibrium of the face.
#pragma once

namespace risorius::face {

/// Statistics of one step, substep or equilibrium. Depths are penetrations beyond those of the rest shape.
struct StepStats {
    int iterations = 0;
    int evaluations = 0;         ///< of the energy and its gradient
    double last_step_rms_m = 0;  ///< RMS move of the nodes in the last iteration
    double contact_depth_m = 0;  ///< maximum penetration of all contacts
    double lip_depth_m = 0;      ///< the same between the lips
    double bone_depth_m = 0;     ///< the same into bone and teeth
    /// Maximum over the volume muscles of |volume / rest volume - 1|.
    double muscle_volume_error = 0;
    bool converged = false;  ///< the tolerance was met before the iterations ran out
};

/// Maximum penetration beyond that of the rest shape, m.
struct Penetration {
    double lips_m = 0;     ///< of one lip into the other
    double bone_m = 0;     ///< of tissue into bone and teeth
    double eyeball_m = 0;  ///< of the lids into the eyeball, cornea included
};

}  // namespace risorius::face
