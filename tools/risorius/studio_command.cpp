// SPDX-License-Identifier: MIT
// risorius view [SCRIPT | RIG]
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/face/quality.h"
#include "risorius/serve/request_checks.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/stop_signals.h"
#include "tools/risorius/studio.h"

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

void check_kind(const fs::path& file) {
    if (file.empty() || file.extension() == ".json") return;
    throw Error(file.string(),
                "a script or a rig, .json; `risorius fit` makes a rig of a mesh with landmarks",
                file.extension().empty() ? "no ending" : in_quotes(file.extension().string()));
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

void run_studio(const StudioArguments& arguments) {
    check_kind(arguments.file);
    (void)face::quality_named(arguments.quality);
    const std::unique_ptr<serve::WebServer> listening = listen_at(arguments.port);
    serve::WebServer& server = *listening;
    Studio studio(arguments.file, arguments.quality);
    if (arguments.common.json)
        std::printf("{\"url\": \"%s\"}\n", server.url().c_str());
    else
        std::printf("The studio is at %s\nCtrl+C ends it.\n", server.url().c_str());
    std::fflush(stdout);
    if (!arguments.no_browser) open_browser(server.url());
    studio.run(server, stop_is_asked);
}

}  // namespace

void add_studio(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "view", "Open a script in a browser: pull the face, move its muscles, edit keys");
    auto arguments = std::make_shared<StudioArguments>();
    command->add_option("FILE", arguments->file, "A script or a rig; without it, the adult");
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
        "Example:\n  risorius view samples/hello/script.json --no-browser");
    command->callback([arguments] { run_studio(*arguments); });
}

}  // namespace risorius::cli
