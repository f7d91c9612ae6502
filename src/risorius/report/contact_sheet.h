// SPDX-License-Identifier: MIT
/// \file
/// Many small pictures on one sheet. Each row of pictures has a heading. Rows are arranged in several blocks side by side, so
/// that the sheet is about as wide as high.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::report {

/// A row of pictures.
struct ContactRow {
    std::string name, numbers;    ///< the heading: a name, and further text
    std::vector<Image> pictures;  ///< all pictures of a sheet have the same size; one per column
};

/// The content of a sheet.
struct ContactSheet {
    std::string title;
    std::vector<std::string> columns;  ///< headings of the columns, from the left
    std::vector<ContactRow> rows;
    /// The colour scale of the pictures; only its ends and name are used. It is not drawn if the name is empty.
    render::SkinValues scale;
};

/// Draws the sheet.
Image draw_contact_sheet(const ContactSheet& sheet);

/// Returns a smaller copy of a picture. Each of its pixels is the mean of the area that it covers.
Image shrunk(const Image& image, int width_px, int height_px);

}  // namespace risorius::report
