// How much of the sky each vertex sees in the rest pose, from depth renders along many directions.
#pragma once

#include <vector>

#include "core/types.h"
#include "render/detail/gl_context.h"

namespace risorius::render {

/// Cosine-weighted share of unblocked directions, 0..1 per vertex. Draws the bound vertex array with the indices of the bound
/// element buffer; the context must be current. One depth render of 512 x 512 per direction, 48 directions.
std::vector<float> sky_seen_at_rest(const Points& rest, const std::vector<float>& normals,
                                    int index_count, const Vec3& centre, double radius_m);

}  // namespace risorius::render
