// The command line: turns arguments into calls of src/app and what they throw into messages and exit codes.
#include <cstdio>

#include "app/watch.h"
#include "commands.h"
#include "core/error.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

int say(ExitCode code, const std::string& message) {
    std::fprintf(stderr, "risorius: %s\n", message.c_str());
    return code;
}

// Mistakes on the command line in the form of all messages: place, expected, found.
std::string message_of(const CLI::ParseError& error, const CLI::App& app, int argc, char** argv) {
    std::string place = "command line", found = "none";
    for (const CLI::App* command : app.get_subcommands()) place = command->get_name();
    const std::string kind = error.get_name(), text = error.what();
    if (place == "command line") {
        for (int i = 1; i < argc; ++i) {
            found = "\"" + std::string(argv[i]) + "\"";
            break;
        }
        std::string names;
        for (const CLI::App* command : app.get_subcommands({})) names += " " + command->get_name();
        return place + ": expected a command, one of" + names + ", found " + found;
    }
    if (kind == "RequiredError")
        return place + ": expected " + text.substr(0, text.find(" is required")) + ", found none";
    if (kind == "ExtrasError") {
        // The words come last argument first.
        const std::size_t colon = text.find(": ");
        return place + ": expected only what risorius " + place + " --help lists, found" +
               text.substr(colon == std::string::npos ? 0 : colon + 1);
    }
    if (kind == "ArgumentMismatch") return place + ": expected a value, found none (" + text + ")";
    return place + ": expected values as risorius " + place + " --help says, found " + text;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace risorius;
    CLI::App app("Faces moved by muscles: from a script to a video.", "risorius");
    app.set_version_flag("--version", "risorius " RISORIUS_VERSION);
    app.require_subcommand(1);
    app.footer("risorius COMMAND --help explains a command and gives an example.");
    cli::add_render(app);
    cli::add_fit(app);
    cli::add_check(app);
    cli::add_info(app);
    cli::catch_interrupts();
    try {
        app.parse(argc, argv);  // runs the command
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        return say(kWrongInput, message_of(error, app, argc, argv));
    } catch (const Error& error) {
        return say(kWrongInput, error.what());
    } catch (const cli::SaidAlready&) {
        return kWrongInput;
    } catch (const app::Interrupted&) {
        return say(kInterrupted, "interrupted, nothing was written");
    } catch (const std::exception& error) {
        return say(kFailed, error.what());
    }
    return kDone;
}

namespace risorius::cli {

void add_common(CLI::App& command, Common& common) {
    command.add_flag("--quiet", common.quiet, "Say nothing but errors");
    command.add_flag("--json", common.json, "The report as JSON on standard output");
}

}  // namespace risorius::cli
