// Many small pictures on one sheet: rows of them under a heading, in as many columns of rows as make the sheet about as wide as high.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::report {

struct ContactRow {
    std::string name, numbers;    ///< heading: what it is, and what is said of it
    std::vector<Image> pictures;  ///< all of one size on a sheet; as many as the sheet has columns
};

struct ContactSheet {
    std::string title;
    std::vector<std::string> columns;  ///< what the pictures of a row show, from the left
    std::vector<ContactRow> rows;
    render::SkinValues
        scale;  ///< of the pictures with colours; its values are not used; none without a name
};

Image draw_contact_sheet(const ContactSheet& sheet);

/// A picture made smaller, every pixel the mean of what it covers.
Image shrunk(const Image& image, int width_px, int height_px);

}  // namespace risorius::report
