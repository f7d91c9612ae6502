// SPDX-License-Identifier: MIT
// risorius head [--identity NAME|FILE] [--seed N] -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/headmodel/sculpt_head.h"
#include "risorius/render/garments.h"
#include "risorius/render/hair_styles.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct HeadArguments {
    Common common;
    headmodel::IdentityChoice choice;
    headmodel::SculptOptions options;
    headmodel::CastOptions cast;
};

void run_cast(HeadArguments& arguments) {
    headmodel::CastOptions& cast = arguments.cast;
    const headmodel::IdentityChoice& choice = arguments.choice;
    cast.seed = choice.seed.value_or(0);
    cast.sex = choice.sex;
    cast.age = choice.age;
    cast.ancestry = choice.ancestry;
    const auto files = headmodel::write_cast(cast, arguments.options.out);
    if (arguments.common.json)
        std::printf("%s\n", json_text(json_object({{"files", files}}), 2).c_str());
    else if (!arguments.common.quiet)
        std::printf("%s: %d persons and cast.tsv\n", arguments.options.out.string().c_str(),
                    cast.count);
}

void run(HeadArguments& arguments) {
    if (arguments.cast.count != 0) return run_cast(arguments);
    arguments.options.identity = headmodel::chosen_identity(arguments.choice);
    if (!arguments.choice.identity.empty()) arguments.options.place = arguments.choice.identity;
    headmodel::SculptReport report;
    {
        ProgressBar bar(arguments.common);
        report = headmodel::sculpt_head(arguments.options, bar.monitor());
    }
    if (arguments.options.identity_only && !arguments.common.json) return;
    if (arguments.common.json) {
        std::printf("%s\n", json_text(report.json(), 2).c_str());
    } else if (!arguments.common.quiet) {
        std::printf("%s: %s\n", report.out.string().c_str(), report.identity.name.c_str());
        for (const std::string& file : report.files) std::printf("  %s\n", file.c_str());
        std::printf("  ITA of the skin: %.0f degrees\n", report.skin_ita_deg);
        std::printf("%s", headmodel::quality_report(report.quality).c_str());
        for (const std::string& note : report.notes) std::printf("note: %s\n", note.c_str());
    }
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? " " : ", ") + name;
    return text;
}

std::string footer() {
    std::string text;
    try {
        const auto tables =
            headmodel::read_design_tables(headmodel::models_folder() / "adult/design");
        text = "Identities:" + listed(headmodel::named_identities()) +
               "\nShapes, in standard deviations from -2 to 2:" +
               listed(headmodel::shape_parameters(tables)) +
               "\nShapes of the population, from -4 to 4 about the mean of sex, age and ancestry:" +
               listed(headmodel::shape_parameters(tables, headmodel::Model::kPopulation)) +
               "\nAncestry:" + listed(tables.ancestries) +
               "\nSkin:" + listed(headmodel::tone_names(tables, "skin")) +
               "\nIris:" + listed(headmodel::tone_names(tables, "iris")) +
               "\nHair:" + listed(headmodel::tone_names(tables, "hair")) + "\n";
    } catch (const Error& error) {
        text = std::string(error.what()) + "\n";
    }
    return text +
           "\nExamples:\n  risorius head --seed 7 -o out/seven\n"
           "  risorius head --sex -1 --age 62 --shape lips=0.8 --shape face_width=-1 -o out/eva\n"
           "  risorius head --cast 24 --seed 1 --balance sex,age,ancestry -o out/cast\n"
           "  risorius head --morph out/cast/p01.json out/cast/p02.json 0.5 -o out/between";
}

void add_people(CLI::App& command, HeadArguments& arguments) {
    headmodel::IdentityChoice& choice = arguments.choice;
    command
        .add_option("--morph", choice.morph,
                    "A B SHARE: the head between the identities A and B; 0 is A, 1 is B")
        ->expected(3);
    command.add_option("--average", choice.average, "The mean of these identities")
        ->expected(1, 1000);
    command.add_option("--exaggerate", choice.exaggerate,
                       "Multiply what distinguishes the person from the mean: 1.5 gives a "
                       "caricature, 0.5 an anti-caricature");
    command.add_flag("--identity-only", arguments.options.identity_only,
                     "Write only identity.json, which takes a few seconds");
    CLI::Option* cast = command.add_option(
        "--cast", arguments.cast.count,
        "Choose this many people who differ from each other, 2 to 200, with --seed. Writes their "
        "identities, p01.json and so on, and the table cast.tsv, but no heads");
    cast->check(CLI::Range(2, 200));
    for (const char* source : {"--identity", "--morph", "--average", "--exaggerate"})
        cast->excludes(command.get_option(source));
    command
        .add_option("--balance", arguments.cast.balance,
                    "What a cast has equally often: sex, age, ancestry, or several of them")
        ->delimiter(',')
        ->needs(cast);
}

}  // namespace

void add_head(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("head", "Make a head with its rig: average, named or random");
    auto arguments = std::make_shared<HeadArguments>();
    headmodel::IdentityChoice& choice = arguments->choice;
    command->add_option("-o,--out", arguments->options.out, "The folder to write")->required();
    command->add_option("--identity", choice.identity,
                        "The head: a name in models/identities, or a .json file like those");
    command->add_option("--seed", choice.seed,
                        "Draw a person from the population of adults with this seed");
    command->add_option("--sex", choice.sex,
                        "-1: female, 1: male. Default: that of the identity, or else 0");
    command->add_option("--age", choice.age, "Age, 20 to 80 years");
    command->add_option("--shape", choice.shape,
                        "PARAMETER=NUMBER, -2 to 2; repeat for several. The parameters are listed "
                        "below");
    command
        ->add_option("--model", choice.model,
                     "1: shapes vary the average adult. 2: they vary the mean of a sex, age and "
                     "ancestry. Default: 2 with --seed or --ancestry, else 1")
        ->check(CLI::IsMember({1, 2}));
    command->add_option("--ancestry", choice.ancestry,
                        "Ancestry; the names are below. It means --model 2");
    add_people(*command, *arguments);
    command->add_option("--skin", choice.skin, "Tone of the skin; the names are below");
    command->add_option("--melanin", choice.melanin,
                        "Tone of the skin by its melanin instead: 0 for the lightest that was "
                        "measured, an ITA of 62 degrees, 1 for the darkest, -60 degrees");
    command->add_option("--haemoglobin", choice.haemoglobin,
                        "Redness beside --melanin, in standard deviations from the mean of people "
                        "of this tone, -3 to 3. Default: 0");
    command->add_option("--garment", choice.garment,
                        "Clothing on the shoulders:" + listed(render::garment_names()));
    command
        ->add_option("--garment-tone", choice.garment_tone,
                     "Its colour: red, green and blue, each from 0 to 1, as in 0.2,0.3,0.4")
        ->delimiter(',')
        ->expected(3);
    command->add_option("--skin-gloss", choice.skin_gloss,
                        "Gloss of the skin, from 0 (powdered) to 2 (oily). Default: 1, or that "
                        "of the identity");
    command->add_option("--iris", choice.iris, "Colour of the eyes; the names are below");
    command->add_option("--hair", choice.hair, "Colour of brows and hair; the names are below");
    command->add_option("--hair-style", choice.hair_style,
                        "Style of the hair:" + listed(render::hair_style_names()));
    command->add_option("--hairline-form", choice.hairline_form,
                        "Form of the hairline:" + listed(render::hairline_form_names()));
    command
        ->add_option("--texture", arguments->options.texture_px,
                     "Also write textures for other programs: skin.png with this width and height "
                     "in pixels (256 to 4096), textures of eyes, teeth, gums, tongue and lashes "
                     "with half of it, and head.mtl, which names them")
        ->check(CLI::Range(256, 4096))
        ->excludes(command->add_flag("--mesh-only", arguments->options.mesh_only,
                                     "Write only mesh and landmarks, without rig and pictures"));
    command->add_flag("--calibrate", arguments->options.calibrate,
                      "Calibrate the strength of each muscle on this head, which takes minutes. "
                      "Default: the strengths of rigs/adult");
    add_common(*command, arguments->common);
    command->footer(std::string());  // not that of all commands
    command->footer(footer);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
