// SPDX-License-Identifier: MIT
#include "tools/risorius/child_job.h"

#include <cctype>
#include <filesystem>
#include <sstream>

namespace risorius::cli {

bool read_progress(const std::string& line, double& fraction, std::string& what) {
    std::istringstream text(line);
    int percent = -1;
    std::string sign;
    if (!(text >> percent >> sign) || sign != "%" || percent < 0 || percent > 100) return false;
    std::getline(text, what);
    std::size_t at = 0;
    while (at < what.size() && std::isspace(static_cast<unsigned char>(what[at]))) ++at;
    what.erase(0, at);
    fraction = percent / 100.0;
    return true;
}

void ChildJob::start(const std::vector<std::string>& arguments, serve::WebServer& server,
                     JobListener listener) {
    std::vector<std::string> command{std::filesystem::read_symlink("/proc/self/exe").string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    running_ = true;
    thread_ = std::make_unique<std::jthread>(
        [this, command, &server, listener = std::move(listener)](const std::stop_token& asked) {
            std::string said;
            const auto line = [&](const std::string& text) {
                double fraction = 0;
                std::string what;
                if (read_progress(text, fraction, what))
                    server.post([listener, fraction, what] {
                        if (listener.progress) listener.progress(fraction, what);
                    });
                else
                    said += text + "\n";
            };
            int exit_code = 1;
            try {
                exit_code =
                    report::run_program(command, {.line = line,
                                                  .stopped = [&] { return asked.stop_requested(); },
                                                  .environment = {"RISORIUS_PROGRESS_S=0.2"}})
                        .exit_code;
            } catch (const std::exception& error) {
                said = error.what();
            }
            const bool cancelled = asked.stop_requested() && exit_code != 0;
            server.post([this, listener, exit_code, cancelled, said] {
                running_ = false;
                listener.ended(exit_code, cancelled, said);
            });
        });
}

void ChildJob::cancel() {
    if (thread_) thread_->request_stop();
}

}  // namespace risorius::cli
