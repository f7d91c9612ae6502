// The command line: turns arguments into calls of src/app and what they throw into messages and exit codes.
#include <cstdio>
#include <cstring>

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
std::string message_of(const CLI::ParseError& error, const CLI::App& app) {
    std::string place = "command line";
    for (const CLI::App* command : app.get_subcommands()) place = command->get_name();
    std::string text = error.what();
    if (const std::size_t line_end = text.find('\n'); line_end != std::string::npos)
        text.resize(line_end);
    const auto after = [&](const char* words) {
        const std::size_t at = text.find(words);
        return at == std::string::npos ? text : text.substr(at + std::strlen(words));
    };
    if (error.get_name() == "RequiredError")
        return place + ": expected " + text.substr(0, text.find(" is required")) + ", found none";
    if (error.get_name() == "ExtrasError")
        return place + ": expected what risorius --help lists, found" +
               after("expected:").substr(0);
    return place + ": " + text;
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
    cli::catch_interrupts();
    try {
        app.parse(argc, argv);  // runs the command
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        return say(kWrongInput, message_of(error, app));
    } catch (const Error& error) {
        return say(kWrongInput, error.what());
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
