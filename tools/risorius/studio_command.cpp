// SPDX-License-Identifier: MIT
// risorius view [SCRIPT | RIG | MESH | EXPERIMENT]
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/face/quality.h"
#include "risorius/serve/request_checks.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/project_files.h"
#include "tools/risorius/stop_signals.h"
#include "tools/risorius/studio.h"
#include "tools/risorius/studio_body.h"
#include "tools/risorius/studio_head.h"

namespace risorius::cli {

namespace {

namespace fs = std::filesystem;

struct StudioArguments {
    Common common;
    fs::path file;
    std::string quality = "preview";
    int port = 0;
    bool no_browser = false;
};

/// The built page: beside the program in a build folder, or with the data of an installation.
fs::path page_folder() {
    const fs::path built = code_folder() / "web" / "page", installed = data_folder() / "page";
    for (const fs::path& folder : {built, installed})
        if (fs::exists(folder / "index.html")) return folder;
    throw Error("the page of the studio",
                "its files in " + built.string() + ", which tools/studio.sh builds with Node.js",
                "none");
}

constexpr const char* kKinds =
    "a script, a rig or an experiment with a soft body, .json, a mesh, or a folder with one of "
    "them";

/// The file that is meant: itself, or what a folder holds.
fs::path file_meant(const fs::path& given) {
    if (!fs::is_directory(given)) return given;
    for (const char* name : {"script.json", "rig.json", "experiment.json"})
        if (fs::exists(given / name)) return given / name;
    throw Error(given.string(), kKinds, "a folder without script.json, rig.json, experiment.json");
}

void check_kind(const fs::path& file) {
    if (file.empty() || file.extension() == ".json" || is_mesh_file(file)) return;
    throw Error(file.string(), kKinds,
                file.extension().empty() ? "no ending" : in_quotes(file.extension().string()));
}

bool is_experiment(const fs::path& file) {
    const ReadingFormerOutput script_may_be_replaced;
    return file.extension() == ".json" &&
           format_of(JsonCursor::read_file(file).json()) == "risorius-experiment";
}

/// Asks the desktop for a browser. Without one, the address is there to be opened by hand.
void open_browser(const std::string& url) {
    std::string program = "xdg-open", address = url;
    char* arguments[] = {program.data(), address.data(), nullptr};
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    (void)posix_spawnp(&child, program.c_str(), &quiet, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&quiet);
}

/// Browsers keep what is not saved by address. So the usual port is tried before any other.
std::unique_ptr<serve::WebServer> listen_at(int port) {
    constexpr int kUsualPort = 8417;
    const serve::Page page = serve::read_page(page_folder().string());
    if (port == 0) {
        try {
            return std::make_unique<serve::WebServer>(page, kUsualPort);
        } catch (const Error&) {  // another studio is there
        }
    }
    return std::make_unique<serve::WebServer>(page, port);
}

/// Says where the page is, and runs it.
template <typename AnyStudio>
void serve_page(const StudioArguments& arguments, serve::WebServer& server, AnyStudio& studio) {
    if (arguments.common.json)
        std::printf("{\"url\": \"%s\"}\n", server.url().c_str());
    else
        std::printf("The studio is at %s\nCtrl+C ends it.\n", server.url().c_str());
    std::fflush(stdout);
    if (!arguments.no_browser) open_browser(server.url());
    studio.run(server, stop_is_asked);
}

void run_studio(const StudioArguments& arguments) {
    const fs::path file = file_meant(arguments.file);
    check_kind(file);
    (void)face::quality_named(arguments.quality);
    if (is_experiment(file)) {
        StudioBody body(file);
        return serve_page(arguments, *listen_at(arguments.port), body);
    }
    const std::unique_ptr<serve::WebServer> listening = listen_at(arguments.port);
    Studio studio(file, arguments.quality);
    serve_page(arguments, *listening, studio);
}

}  // namespace

void add_studio(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "view", "Open a script in a browser: pull the face, move its muscles, edit keys");
    auto arguments = std::make_shared<StudioArguments>();
    command->add_option("FILE", arguments->file,
                        "A script, a rig, a mesh that is to become one, or a soft body of "
                        "samples/figures; without it, the adult");
    command
        ->add_option("--port", arguments->port,
                     "The port to listen at. 0: 8417, or a free port if 8417 is in use")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    command->add_flag("--no-browser", arguments->no_browser,
                      "Only print the address, and open no browser");
    command
        ->add_option("--quality", arguments->quality,
                     "Quality of the simulation: draft, preview, video or fine")
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Only this computer can reach the page, and only with the address that is printed. "
        "tools/studio.sh builds the page.\n\n"
        "Examples:\n  risorius view samples/hello/script.json --no-browser\n"
        "  risorius view head.obj\n"
        "  risorius view samples/figures/8e");
    command->callback([arguments] { run_studio(*arguments); });
}

}  // namespace risorius::cli
