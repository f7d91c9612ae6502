// SPDX-License-Identifier: MIT
/// \file
/// Landmarks that their definition finds better than any comparison with another head. They are looked for near where the
/// comparison puts them.
///
/// - Corners of the eyes: where the crease between two lids ends. Seen from the front, the normals above and below a crease differ;
///   columns are followed outwards until they no longer do.
/// - Highest and lowest points of the lids (ps, pi): half of the way to where their edge is highest or lowest.
/// - Stomion and corners of the mouth: the middle and the ends of the line along which the lips meet (lip_line.h).
/// - Upper and lower vermilion border (ls, li): the ridge of the midline, where the profile turns most, beyond the roll of the lip.
/// - Pronasale and nasion: the mean of where the comparison puts them and of the point of the midline that is most forward, or farthest
///   back. As both depend on the tilt of the head, neither decides alone.
#pragma once

#include <map>
#include <string>

#include "risorius/landmarks/detail/shown_head.h"

namespace risorius::landmarks {

/// `head`: upright, facing +z, in m, about as large as the average adult. `at`: where the comparison puts each landmark. Returns
/// those that were found, on the skin.
std::map<std::string, Vec3> found_in_front(const ShownHead& head,
                                           const std::map<std::string, Vec3>& at);

/// The landmarks of the line of the lips (sto, ch_l, ch_r), if the comparison misses it by more than 4 mm; else nothing.
std::map<std::string, Vec3> missed_lips(const ShownHead& head,
                                        const std::map<std::string, Vec3>& at);

}  // namespace risorius::landmarks
