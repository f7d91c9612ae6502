// SPDX-License-Identifier: MIT
/// \file
/// Many small pictures on one sheet. Each row of pictures has a heading; rows are set in several columns, so that the sheet is about
/// as wide as high.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::report {

struct ContactRow {
    std::string name, numbers;    ///< the heading: a name, and text about the row
    std::vector<Image> pictures;  ///< all of one size on a sheet; as many as the sheet has columns
};

struct ContactSheet {
    std::string title;
    std::vector<std::string> columns;  ///< headings of the columns, from the left
    std::vector<ContactRow> rows;
    /// The colour scale of the pictures; only its ends and name are used. Without a name none is drawn.
    render::SkinValues scale;
};

Image draw_contact_sheet(const ContactSheet& sheet);

/// A smaller copy of a picture: each pixel is the mean of the area that it covers.
Image shrunk(const Image& image, int width_px, int height_px);

}  // namespace risorius::report
