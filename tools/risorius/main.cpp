// SPDX-License-Identifier: MIT
// The command line: turns arguments into calls of the library, and exceptions into messages and exit codes.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/known_names.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/core/readable_text.h"
#include "risorius/core/version.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/failure.h"
#include "tools/risorius/manual_pages.h"
#include "tools/risorius/stop_signals.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

int say(ExitCode code, const std::string& message) {
    std::fprintf(stderr, "risorius: %s\n", message.c_str());
    return code;
}

bool wants_json(int argc, char** argv) {
    char** const end = argv + std::max(argc, 1);
    return std::find(argv + 1, end, std::string_view("--json")) != end;
}

/// Says why the run ended: in words and, with --json, in one line of JSON where the report would be.
/// A message may quote what the input holds, of any length, so it is cut. A path has up to 4096 bytes.
int say_why(ExitCode code, const std::string& words, bool json) {
    const std::string message = risorius::shortened_text(words, 8000);
    if (json) std::fputs(risorius::cli::failure_line(code, message).c_str(), stdout);
    return say(code, message);
}

using risorius::in_quotes;

/// The flag that sets a field of an options struct: the name of the field without its unit.
std::string flag_of(const std::string& field) {
    std::string flag = field;
    for (const char* unit : {"_s", "_deg", "_mm", "_px"})
        if (flag.ends_with(unit)) flag.erase(flag.size() - std::string(unit).size());
    std::replace(flag.begin(), flag.end(), '_', '-');
    return "--" + flag;
}

/// "0.3" of "0.300000", as CLI11 prints the ends of ranges.
std::string without_zeros(const std::string& number) {
    return std::regex_replace(number, std::regex("(\\.[0-9]*[1-9])0+$|\\.0+$"), "$1");
}

// Converts errors of the command line to the form of all messages: place, expected, found.
std::string message_of(const CLI::ParseError& error, const CLI::App& app, int argc, char** argv) {
    if (app.get_subcommands().empty()) {
        std::string listed;
        std::vector<std::string> names;
        for (const CLI::App* command : app.get_subcommands({})) {
            if (command->get_group().empty()) continue;  // hidden
            names.push_back(command->get_name());
            listed += " " + names.back();
        }
        return "command line: expected a command, one of" + listed +
               (argc > 1 ? risorius::did_you_mean(argv[1], names) + ", found " + in_quotes(argv[1])
                         : ", found none");
    }
    const CLI::App& command = *app.get_subcommands().front();
    const std::string place = command.get_name(), text = error.what();
    if (dynamic_cast<const CLI::RequiredError*>(&error))
        return place + ": expected " + text.substr(0, text.find(" is required")) + ", found none";
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extra = command.remaining(true);
        const std::string found = extra.empty() ? text : extra.front();
        std::vector<std::string> names;
        if (found.starts_with("--"))
            for (const CLI::Option* option : command.get_options())
                for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        return place + ": expected only what risorius " + place + " --help lists" +
               risorius::did_you_mean(found.substr(0, found.find('=')), names) + ", found " +
               in_quotes(found);
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) &&
        text.find("received") != std::string::npos)  // "--fps: At Most 1 required but received 2"
        return place + " " + text.substr(0, text.find(':')) + ": expected one value, found " +
               text.substr(text.rfind(' ') + 1);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        return place + " " + text.substr(0, text.find(':')) + ": expected a value, found none";
    if (dynamic_cast<const CLI::ConversionError*>(&error)) {
        // Messages such as "Could not convert: --fps = 3.5"
        const std::size_t name = text.find("--"), equals = text.find(" = ");
        if (name != std::string::npos && equals != std::string::npos) {
            const std::string option = text.substr(name, equals - name);
            const bool whole = command.get_option(option)->get_type_name() == "INT";
            return place + " " + option + ": expected " + (whole ? "an integer" : "a number") +
                   ", found " + in_quotes(text.substr(equals + 3));
        }
    }
    // Messages such as "--texture: Value 99999 not in range 256 to 4096", "--quality: best not in {draft,fine}", "--steps
    // excludes --shapes"
    std::smatch part;
    if (std::regex_match(text, part, std::regex("(.*): Value (.*) not in range (.*) to (.*)")))
        return place + " " + part.str(1) + ": expected a number in [" + without_zeros(part.str(3)) +
               ", " + without_zeros(part.str(4)) + "], found " + part.str(2);
    if (std::regex_match(text, part, std::regex("(--[^:]*): (expected .*)")))
        return place + " " + part.str(1) + ": " + part.str(2);
    if (std::regex_match(text, part, std::regex("(.*): (.*) not in \\{(.*)\\}")))
        return place + " " + part.str(1) + ": expected one of " +
               std::regex_replace(part.str(3), std::regex(","), ", ") + ", found " +
               in_quotes(part.str(2));
    if (std::regex_match(text, part, std::regex("(--[^ ]*) excludes (--[^ ]*)")))
        return place + ": expected " + part.str(1) + " or " + part.str(2) + ", found both";
    if (std::regex_match(text, part, std::regex("(--[^ ]*) requires (--[^ ]*)")))
        return place + ": expected " + part.str(2) + " with " + part.str(1) + ", found none";
    return place + ": expected what risorius " + place + " --help says, found " + text;
}

/// Why a text is no number that an option may have; empty when it is one. CLI11 takes an empty text for 0, and its ranges hold
/// NaN.
std::string why_no_number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty()) return "expected a number, found none";
    if (end != text.c_str() && !std::isfinite(value))
        return "expected a finite number, found " + text;
    return "";
}

/// Names the value of every option that takes text after the option: -o,--out OUT instead of TEXT. Allowed values stand in the
/// descriptions, not behind the type.
void name_values(CLI::App& command) {
    for (CLI::Option* option : command.get_options()) {
        const std::string type = option->get_type_name();
        if (type.starts_with("FLOAT") || type.starts_with("INT") || type.starts_with("UINT"))
            option->check(CLI::Validator(why_no_number, ""));
        try {
            for (int i = 0;; ++i) option->get_validator(i)->description("");
        } catch (const CLI::OptionNotFound&) {  // there is no way to ask for their number
        }
        if (option->get_type_name() == "TEXT" && !option->get_lnames().empty()) {
            std::string name = option->get_lnames().front();
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return c == '-' ? '_' : std::toupper(c); });
            option->type_name(name);
        }
    }
    for (CLI::App* part : command.get_subcommands({})) name_values(*part);
}

int run(int argc, char** argv) {
    using namespace risorius;
    CLI::App app("Faces moved by muscles: from a script to a video.", "risorius");
    app.set_version_flag("--version", std::string("risorius ") + risorius::kVersion);
    app.require_subcommand(1);
    app.footer("risorius COMMAND --help explains a command and gives an example.");
    cli::add_render(app);
    cli::add_speak(app);
    cli::add_align(app);
    cli::add_compare(app);
    cli::add_sheet(app);
    cli::add_landmarks(app);
    cli::add_fit(app);
    cli::add_head(app);
    cli::add_check(app);
    cli::add_info(app);
    cli::add_evaluate(app);
    cli::add_shapes(app);
    cli::add_solve(app);
    cli::add_import(app);
    cli::add_export(app);
    cli::add_batch(app);
    cli::add_reverse(app);
    cli::add_study(app);
    cli::add_studio(app);
    cli::add_bench(app);
    cli::add_figure(app);
    std::string manual_folder;
    CLI::App* manual =
        app.add_subcommand("manual-pages", "Man pages, completions and docs/cli.md into a folder");
    manual->group("")->add_option("FOLDER", manual_folder, "The folder")->required();  // hidden
    manual->callback([&] { cli::write_manual_pages(app, manual_folder); });
    name_values(app);
    const InputLog inputs;  // no output takes the place of one
    const auto say = [&](ExitCode code, const std::string& message) {
        return say_why(code, message, wants_json(argc, argv));
    };
    try {
        if (cli::stop_is_asked()) throw Interrupted();  // before the run began
        app.parse(argc, argv);                          // also runs the command
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        return say(kWrongInput, message_of(error, app, argc, argv));
    } catch (const Error& error) {
        return say(kWrongInput, error.worded(flag_of));
    } catch (const cli::SaidAlready&) {
        return kWrongInput;
    } catch (const Interrupted&) {
        cli::end_of_run();
        return say(kInterrupted, cli::stop_message());
    } catch (const std::bad_alloc&) {
        return say(kFailed, "not enough memory");
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string path = error.path1().string(), reason = error.code().message();
        if (error.code() == std::errc::filename_too_long ||
            error.code() == std::errc::too_many_symbolic_link_levels)
            return say(kWrongInput, Error(path, "a path that the system takes", reason).what());
        return say(kFailed, readable_text(path + ": " + reason));
    } catch (const std::exception& error) {
        return say(kFailed, readable_text(error.what()));
    }
    return kDone;
}

/// For exceptions that nobody can catch. The destructor of a JSON value needs memory; where it gets none, the program ends here.
[[noreturn]] void end_without_memory() {
    try {
        if (const std::exception_ptr thrown = std::current_exception())
            std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        constexpr std::string_view kMessage = "risorius: not enough memory\n";
        if (::write(STDERR_FILENO, kMessage.data(), kMessage.size()) >= 0) ::_exit(kFailed);
        ::_exit(kFailed);
    } catch (...) {
    }
    std::abort();
}

// A signal that comes while the libraries are initialised, for some tenths of a second on a busy machine, ends the run as any other
// does. Sanitizers have to come first.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
[[maybe_unused]] const bool noted = (risorius::cli::note_stops(), true);
#else
[[gnu::used, gnu::section(".preinit_array")]] void (*first_of_all)() = risorius::cli::note_stops;
#endif

/// Whether everything that was printed has arrived.
bool is_printed() {
    std::cout.flush();
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
}

}  // namespace

/// Takes the place of the function of the C library. Mesa gives the thread that writes its cache of shaders the lowest priority. The
/// system keeps a process until each of its threads had a turn, and on a busy machine a run that was stopped waited 4 to 9 s for
/// that of this one. It works for tenths of a second and may have the usual priority.
extern "C" int setpriority(__priority_which_t, id_t, int) noexcept { return 0; }

int main(int argc, char** argv) {
    std::set_terminate(end_without_memory);
    risorius::cli::catch_stop_signals(wants_json(argc, argv));
    const int code = run(argc, argv);
    risorius::cli::end_of_run();
    const bool printed = is_printed();
    // At once: what libraries do at the end may take seconds.
    if (code == kInterrupted) std::_Exit(code);
    if (printed || code != kDone) return code;
    return say(kFailed, "standard output: the report cannot be written");
}
