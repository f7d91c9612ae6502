// SPDX-License-Identifier: MIT
/// \file
/// Marks in a corner of every picture for equipment that watches the screen: a square for a photodiode, and the frame number as
/// black and white cells. Any encoder preserves the cells, and reading them needs no font.
///
/// The counter is a strip of 24 square cells. From the left: white, black, the number as 20 bits with the most significant bit
/// first (white is 1), a cell that makes the number of white bits even, white. Numbers start again at 2^20.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// Corners of the picture.
enum class Corner { kUpperLeft, kUpperRight, kLowerLeft, kLowerRight };
/// The names of the corners: "upper_left", "upper_right", "lower_left", "lower_right".
const std::vector<std::string>& corner_names();
/// Throws Error at `place` for an unknown name.
Corner corner_named(const std::string& name, const std::string& place);

inline constexpr int kCounterCells = 24;

/// Draws a white or black square with the given side, px, clipped to the picture.
void draw_photodiode(Corner corner, int side_px, bool lit, Image& image);

/// Draws the counter. `cell_px`: side of a cell.
void draw_frame_counter(Corner corner, int cell_px, int frame, Image& image);
/// Reads the number from a picture; nothing when there is no counter or its parity is wrong.
std::optional<int> read_frame_counter(Corner corner, int cell_px, const Image& image);

}  // namespace risorius::media
