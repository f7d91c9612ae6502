// SPDX-License-Identifier: MIT
/// \file
/// The face of a session as a job needs it.
#pragma once

#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"

namespace risorius::animate {

/// The face of the session, prepared for the job's script.
face::Face& ready_face(const RenderJob& job, RenderSession& session);

/// Mirrors vertical motion: each vertex is as far below its rest position as it was above it.
void flip_motion(const Points& rest, face::FacePose& pose);

}  // namespace risorius::animate
