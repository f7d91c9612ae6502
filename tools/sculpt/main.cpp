// sculpt: makes the embedded head from its design tables. See models/adult/ORIGIN.md.
#include <cstdio>
#include <string>

#include "core/error.h"
#include "sculpt/head_quality.h"

int main(int argc, char** argv) {
    std::filesystem::path design = risorius::sculpt::models_folder() / "adult/design", output;
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
        const auto tables = risorius::sculpt::read_design_tables(design);
        const auto model = risorius::sculpt::make_head(tables);
        if (!output.empty()) {
            std::filesystem::create_directories(output);
            risorius::sculpt::write_head(model, output);
        }
        std::printf("%s",
                    risorius::sculpt::quality_report(risorius::sculpt::head_quality(model, tables))
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
