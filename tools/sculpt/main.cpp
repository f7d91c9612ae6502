// SPDX-License-Identifier: MIT
// sculpt: makes the built-in head from its design tables. See models/adult/ORIGIN.md.
#include <cstdio>
#include <string>

#include "risorius/core/error.h"
#include "risorius/headmodel/head_quality.h"

int main(int argc, char** argv) {
    std::filesystem::path design = risorius::headmodel::models_folder() / "adult/design", output;
    for (int k = 1; k < argc; ++k) {
        const std::string flag = argv[k];
        if (flag == "--output" && k + 1 < argc) {
            output = argv[++k];
        } else if (flag == "--design" && k + 1 < argc) {
            design = argv[++k];
        } else {
            std::printf(
                "usage: sculpt --output FOLDER [--design FOLDER]\n"
                "writes head.obj and landmarks.json, prints how well the head meets the design "
                "tables\n"
                "example: sculpt --output models/adult\n");
            return flag == "--help" ? 0 : 2;
        }
    }
    try {
        const auto tables = risorius::headmodel::read_design_tables(design);
        const auto model = risorius::headmodel::make_head(tables);
        if (!output.empty()) {
            std::filesystem::create_directories(output);
            risorius::headmodel::write_head(model, output);
        }
        std::printf("%s", risorius::headmodel::quality_report(
                              risorius::headmodel::head_quality(model, tables))
                              .c_str());
        return 0;
    } catch (const risorius::Error& error) {
        std::fprintf(stderr, "sculpt: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sculpt: %s\n", error.what());
        return 1;
    }
}
