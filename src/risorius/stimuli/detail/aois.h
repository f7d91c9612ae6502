// SPDX-License-Identifier: MIT
/// \file
/// Areas of interest for eye tracking: where eyes, brows, nose, mouth and face are in each frame, as polygons.
///
///   eye, mouth, nose    through their landmarks
///   brow                a band of 3 % of the width of the face above and below its landmarks
///   face                the oval of face_oval.h
///
/// Polygons are grown outwards by a margin, but never so much that two of them, the face apart, would meet.
#pragma once

#include <string>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/report/html_writer.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

struct Aoi {
    std::string name;  ///< one of design::aoi_names()
    std::vector<Vec2>
        polygon;         ///< px, from the upper left corner of the picture; empty when not visible
    double area_px = 0;  ///< in px^2
};

/// Returns the areas of a frame, in the order of `names`. An area that looks away, or lies outside the picture, is empty.
/// `margin_px`: how much they grow.
std::vector<Aoi> aois_of(const animate::FrameRows& rows, int frame,
                         const std::vector<std::string>& names, double face_px, double margin_px,
                         int width_px, int height_px);

/// The files of a clip's areas.
struct AoiFiles {
    std::string table;    ///< a row per frame and area, for BIDS
    std::string columns;  ///< what its columns are, JSON
    /// Key frames in the form of the request AddAois of the project interface of Tobii Pro Lab, JSON. A key frame is left out where no
    /// corner has moved by more than half a pixel.
    std::string key_frames;
    /// The same key frames as areas of SR Research Data Viewer: "-start -end FREEHAND id x,y x,y ... name" with times in ms after the
    /// message that loads the file; without times where the clip is still.
    std::string ias;
};

/// Draws the areas over the five frames of a strip. `table`: AoiFiles::table.
void draw_aois(const std::string& table, const ClipPlan& plan, report::HtmlWriter& html);

/// Returns the areas of the clip as shown. `rows`: the frames of the script; `order`: for each frame of the clip, its row.
AoiFiles aoi_files(const animate::FrameRows& rows, const std::vector<int>& order,
                   const ClipPlan& plan);

}  // namespace risorius::stimuli
