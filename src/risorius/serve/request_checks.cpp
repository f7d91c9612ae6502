// SPDX-License-Identifier: MIT
#include "risorius/serve/request_checks.h"

#include <sys/random.h>

#include <array>
#include <filesystem>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"

namespace risorius::serve {

namespace {

constexpr FileKind kPageFile{"a file of the page", 8 * kMegabyte};

struct NamedFile {
    const char *target, *name, *type;
};
constexpr NamedFile kPageFiles[] = {{"/", "index.html", "text/html; charset=utf-8"},
                                    {"/studio.js", "studio.js", "text/javascript; charset=utf-8"},
                                    {"/studio.css", "studio.css", "text/css; charset=utf-8"},
                                    {"/icon.svg", "icon.svg", "image/svg+xml"}};

bool is_this_computer(std::string_view name, int port) {
    const std::string end = ":" + std::to_string(port);
    return name == "127.0.0.1" + end || name == "localhost" + end;
}

bool is_this_page(std::string_view origin, int port) {
    constexpr std::string_view kScheme = "http://";
    return origin.starts_with(kScheme) && is_this_computer(origin.substr(kScheme.size()), port);
}

}  // namespace

const char* const kContentPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' "
    "data: blob:; media-src 'self' blob:; connect-src 'self'; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; "
    "frame-ancestors 'none'";

Answer answer_to(const RequestHead& request, int port, const Page& page) {
    if (!request.one_of_each || !is_this_computer(request.host, port)) return Answer::kForbidden;
    if (!request.origin.empty() && !is_this_page(request.origin, port)) return Answer::kForbidden;
    if (request.method != "GET" && request.method != "HEAD") return Answer::kNotAllowed;
    if (request.target == kSocketTarget) {
        if (!request.upgrade || request.method != "GET") return Answer::kNotFound;
        return is_this_page(request.origin, port) ? Answer::kSocket : Answer::kForbidden;
    }
    return page.contains(request.target) && !request.upgrade ? Answer::kFile : Answer::kNotFound;
}

bool same_token(std::string_view token, std::string_view given) {
    unsigned difference = token.size() == given.size() && !token.empty() ? 0 : 1;
    for (std::size_t i = 0; i < given.size(); ++i)
        difference |= static_cast<unsigned char>(given[i]) ^
                      static_cast<unsigned char>(token.empty() ? 1 : token[i % token.size()]);
    return difference == 0;
}

std::string new_token() {
    std::array<unsigned char, 16> bits{};
    if (::getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
        throw RunError("the system gives no random numbers");
    std::string out;
    for (const unsigned char byte : bits)
        for (const int digit : {byte >> 4, byte & 15}) out += "0123456789abcdef"[digit];
    return out;
}

Page read_page(const std::string& folder) {
    Page page;
    for (const NamedFile& file : kPageFiles)
        page[file.target] = {file.type,
                             read_file(std::filesystem::path(folder) / file.name, kPageFile)};
    return page;
}

}  // namespace risorius::serve
