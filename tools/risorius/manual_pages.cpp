// SPDX-License-Identifier: MIT
#include "tools/risorius/manual_pages.h"

#include <sstream>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/core/version.h"

namespace risorius::cli {
namespace {

namespace fs = std::filesystem;

/// The commands for users; commands without a group are hidden.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    std::vector<const CLI::App*> commands;
    for (const CLI::App* command : app.get_subcommands({}))
        if (!command->get_group().empty() && !command->get_name().empty())
            commands.push_back(command);
    return commands;
}

struct Flag {
    std::string shorts, longs, value, fallback, description, group;
    bool required = false, positional = false;
    std::string names() const { return shorts + (shorts.empty() ? "" : ", ") + longs; }
};

std::string value_of(const CLI::Option& option) {
    if (option.get_expected_max() == 0) return "";  // a switch
    std::string type = option.get_type_name();
    return option.get_expected_max() > 1 ? type + " ..." : type;
}

void add_flags(const CLI::App& command, std::vector<Flag>& flags) {
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;  // hidden
        Flag flag;
        flag.positional = option->get_positional();
        for (const std::string& name : option->get_snames()) flag.shorts += "-" + name;
        for (const std::string& name : option->get_lnames()) flag.longs += "--" + name;
        if (flag.positional)
            flag.longs = option->get_name() + (option->get_expected_max() > 1 ? " ..." : "");
        flag.value = flag.positional ? "" : value_of(*option);
        flag.fallback = option->get_default_str();
        flag.description = option->get_description();
        flag.required = option->get_required();
        flag.group = flag.positional ? "" : option->get_group();
        flags.push_back(flag);
    }
}

/// Positional arguments, followed by options in their order, including those of nested option groups.
std::vector<Flag> flags_of(const CLI::App& command) {
    std::vector<Flag> flags;
    add_flags(command, flags);
    for (const CLI::App* group : command.get_subcommands({}))
        if (group->get_name().empty()) {
            const std::size_t before = flags.size();
            add_flags(*group, flags);
            for (std::size_t i = before; i < flags.size(); ++i) flags[i].group = group->get_group();
        }
    std::stable_partition(flags.begin(), flags.end(),
                          [](const Flag& flag) { return flag.positional; });
    return flags;
}

std::string usage_of(const CLI::App& command) {
    std::string usage = "risorius " + command.get_name();
    for (const Flag& flag : flags_of(command))
        if (flag.positional)
            usage += flag.required ? " " + flag.names() : " [" + flag.names() + "]";
        else if (flag.required)
            usage += " " + (flag.shorts.empty() ? flag.longs : flag.shorts) + " " + flag.value;
    return usage + " [OPTIONS]";
}

/// The text below the options in the help of a command.
struct Footer {
    std::vector<std::string> notes, examples;  ///< lines
};

Footer footer_of(const CLI::App& command) {
    Footer footer;
    std::istringstream text(command.get_footer());
    for (std::string line; std::getline(text, line);) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin == std::string::npos || line == "Example:" || line == "Examples:") continue;
        const bool is_command = line.compare(begin, 9, "risorius ") == 0;
        (is_command ? footer.examples : footer.notes).push_back(line.substr(begin));
    }
    return footer;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t i = 0; (i = text.find(what, i)) != std::string::npos; i += with.size())
        text.replace(i, what.size(), with);
    return text;
}

std::string in_table(const std::string& text) {
    return replaced(replaced(replaced(text, "|", "\\|"), "<", "&lt;"), "\n", " ");
}

/// Escapes text for troff: hyphens stay hyphens, and no line starts a request.
std::string troff(std::string text) {
    text = "\n" + replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    for (const std::string request : {".", "'"})
        text = replaced(text, "\n" + request, "\n\\&" + request);
    return text.substr(1);
}

std::string in_single_quotes(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

/// The values for completion that a description or a check lists, for instance "{draft,preview}" as a type name.
std::string choices_of(const Flag& flag) {
    const std::size_t open = flag.value.find('{'), close = flag.value.find('}', open);
    if (open == std::string::npos || close == std::string::npos) return "";
    return replaced(flag.value.substr(open + 1, close - open - 1), ",", " ");
}

void write(const fs::path& file, const std::string& text, std::vector<fs::path>& written) {
    write_file(file, text);
    written.push_back(file);
}

}  // namespace

std::string markdown_pages(const CLI::App& app) {
    std::string page =
        "# Command line\n\nThis page is made from `risorius --help`.\n\n| command | does "
        "|\n|---|---|\n";
    for (const CLI::App* command : commands_of(app))
        page += "| [`" + command->get_name() + "`](#risorius-" + command->get_name() + ") | " +
                in_table(command->get_description()) + " |\n";
    page +=
        "\n| exit code | means |\n|---|---|\n"
        "| 0 | The run is done. |\n"
        "| 1 | The run failed: the disk is full, memory is short, a file cannot be written, or a "
        "measured number of a figure lies outside its accepted range. |\n"
        "| 2 | The input or the command line is wrong. The message gives the place, what was "
        "expected and what was found. Nothing is left behind. |\n"
        "| 130 | The run was interrupted (Ctrl-C). Half-made files are removed; finished clips of "
        "a set "
        "stay. |\n";
    for (const CLI::App* command : commands_of(app)) {
        page += "\n## risorius " + command->get_name() + "\n\n" + command->get_description() +
                ".\n\n```text\n" + usage_of(*command) + "\n```\n";
        std::string group = "-";
        for (const Flag& flag : flags_of(*command)) {
            if (flag.group != group) {
                group = flag.group;
                page += "\n" +
                        (group.empty() || group == "Options" ? std::string()
                                                             : "**" + group + "**\n\n") +
                        "| " + (group.empty() ? "argument" : "option") + " | means |\n|---|---|\n";
            }
            page += "| `" + flag.names() + (flag.value.empty() ? "" : " " + in_table(flag.value)) +
                    "` | " + in_table(flag.description) + (flag.required ? ". Required" : "") +
                    (flag.fallback.empty() ? "" : ". Default: " + in_table(flag.fallback)) + " |\n";
        }
        const Footer footer = footer_of(*command);
        for (const std::string& note : footer.notes) page += "\n" + note + "\n";
        if (!footer.examples.empty()) {
            page += "\n```text\n";
            for (const std::string& example : footer.examples) page += example + "\n";
            page += "```\n";
        }
    }
    return page;
}

std::string man_page(const CLI::App& app, const CLI::App* command) {
    const std::string name = command ? "risorius-" + command->get_name() : "risorius";
    std::string page = ".TH " + replaced(name, "-", "\\-") + " 1 \"\" \"risorius " + kVersion +
                       "\" \"User Commands\"\n.SH NAME\n" + troff(name) + " \\- " +
                       troff(command ? command->get_description() : app.get_description()) + "\n";
    if (!command) {
        page += ".SH SYNOPSIS\n.B risorius\n.I COMMAND\n[OPTIONS]\n.SH COMMANDS\n";
        for (const CLI::App* one : commands_of(app))
            page += ".TP\n.BR risorius\\-" + troff(one->get_name()) + " (1)\n" +
                    troff(one->get_description()) + "\n";
        page +=
            ".SH EXIT STATUS\n.TP\n0\nThe run is done.\n.TP\n1\nThe run failed.\n.TP\n2\nThe input "
            "or the command line is wrong; the message gives the place, the expected value and "
            "the found one. Nothing is left behind.\n.TP\n130\nThe run was interrupted. "
            "Half-made files are removed; finished clips of a set stay.\n.SH ENVIRONMENT\n.TP\n.B "
            "RISORIUS_DATA\nThe "
            "folder that holds rigs, models and samples.\n.TP\n.B RISORIUS_GL\nWhat draws: auto, "
            "osmesa or egl.\n";
        return page;
    }
    page += ".SH SYNOPSIS\n.nf\n" + troff(usage_of(*command)) + "\n.fi\n.SH OPTIONS\n";
    std::string group;
    for (const Flag& flag : flags_of(*command)) {
        if (!flag.group.empty() && flag.group != group) {
            group = flag.group;
            if (group != "Options") page += ".SS " + troff(group) + "\n";
        }
        page += ".TP\n.B " + troff(flag.names()) +
                (flag.value.empty() ? "" : " " + troff(flag.value)) + "\n" +
                troff(flag.description) + (flag.required ? ". Required" : "") +
                (flag.fallback.empty() ? "" : ". Default: " + troff(flag.fallback)) + "\n";
    }
    const Footer footer = footer_of(*command);
    if (!footer.notes.empty()) page += ".SH NOTES\n";
    for (const std::string& note : footer.notes) page += ".PP\n" + troff(note) + "\n";
    if (!footer.examples.empty()) {
        page += ".SH EXAMPLES\n.nf\n";
        for (const std::string& example : footer.examples) page += troff(example) + "\n";
        page += ".fi\n";
    }
    return page + ".SH SEE ALSO\n.BR risorius (1)\n";
}

std::string bash_completion(const CLI::App& app) {
    std::string names, cases;
    for (const CLI::App* command : commands_of(app)) {
        names += (names.empty() ? "" : " ") + command->get_name();
        std::string options, values;
        for (const Flag& flag : flags_of(*command)) {
            if (flag.positional) continue;
            options += (options.empty() ? "" : " ") + flag.longs;
            if (const std::string choices = choices_of(flag); !choices.empty())
                values += "            " + command->get_name() + flag.longs + ") choices=\"" +
                          choices + "\" ;;\n";
        }
        cases += "        " + command->get_name() + ") options=\"" + options + "\" ;;\n";
        if (!values.empty())
            cases += "    esac\n    case ${COMP_WORDS[1]}$previous in\n" + values +
                     "    esac\n    case ${COMP_WORDS[1]} in\n";
    }
    return "# bash completion for risorius, made from risorius --help\n"
           "_risorius() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local options= choices=\n"
           "    if [[ $COMP_CWORD == 1 ]]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           names +
           " --help --version\" -- \"$word\"))\n"
           "        return\n"
           "    fi\n"
           "    case ${COMP_WORDS[1]} in\n" +
           cases +
           "    esac\n"
           "    if [[ -n $choices ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$choices\" -- \"$word\"))\n"
           "    elif [[ $word == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "    else\n"
           "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "    fi\n"
           "}\n"
           "complete -o filenames -F _risorius risorius\n";
}

std::string zsh_completion(const CLI::App& app) {
    std::string list, cases;
    for (const CLI::App* command : commands_of(app)) {
        list += "        " +
                in_single_quotes(command->get_name() + ":" +
                                 replaced(command->get_description(), ":", "\\:")) +
                "\n";
        cases += "        " + command->get_name() + ")\n            _arguments";
        for (const Flag& flag : flags_of(*command)) {
            if (flag.positional) continue;
            const std::string about =
                replaced(replaced(replaced(flag.description, ":", "\\:"), "[", "("), "]", ")");
            const std::string choices = choices_of(flag);
            cases += " \\\n                " +
                     in_single_quotes(flag.longs + "[" + about + "]" +
                                      (flag.value.empty() ? ""
                                       : choices.empty()  ? ":value:_files"
                                                          : ":value:(" + choices + ")"));
        }
        cases += " \\\n                '*:file:_files'\n            ;;\n";
    }
    return "#compdef risorius\n# zsh completion for risorius, made from risorius --help\n\n"
           "_risorius() {\n    local -a commands\n    commands=(\n" +
           list +
           "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n        "
           "return\n    fi\n    local command=$words[2]\n    shift words\n    (( CURRENT-- ))\n"
           "    case $command in\n" +
           cases + "    esac\n}\n\n_risorius \"$@\"\n";
}

std::string fish_completion(const CLI::App& app) {
    std::string out = "# fish completion for risorius, made from risorius --help\n";
    for (const CLI::App* command : commands_of(app)) {
        out += "complete -c risorius -n __fish_use_subcommand -a " + command->get_name() + " -d " +
               in_single_quotes(command->get_description()) + "\n";
        for (const Flag& flag : flags_of(*command)) {
            if (flag.positional) continue;
            out += "complete -c risorius -n '__fish_seen_subcommand_from " + command->get_name() +
                   "' -l " + flag.longs.substr(2);
            if (!flag.shorts.empty()) out += " -s " + flag.shorts.substr(1);
            if (!flag.value.empty()) out += " -r";
            if (const std::string choices = choices_of(flag); !choices.empty())
                out += " -f -a " + in_single_quotes(choices);
            out += " -d " + in_single_quotes(flag.description) + "\n";
        }
    }
    return out;
}

std::vector<fs::path> write_manual_pages(const CLI::App& app, const fs::path& folder) {
    std::vector<fs::path> written;
    write(folder / "cli.md", markdown_pages(app), written);
    write(folder / "man1/risorius.1", man_page(app, nullptr), written);
    for (const CLI::App* command : commands_of(app))
        write(folder / "man1" / ("risorius-" + command->get_name() + ".1"), man_page(app, command),
              written);
    write(folder / "bash/risorius", bash_completion(app), written);
    write(folder / "zsh/_risorius", zsh_completion(app), written);
    write(folder / "fish/risorius.fish", fish_completion(app), written);
    return written;
}

}  // namespace risorius::cli
