// SPDX-License-Identifier: MIT
// Which requests are answered: only those of the page itself, compared as whole strings.
#include "risorius/serve/request_checks.h"

#include <gtest/gtest.h>

#include <set>

#include "message_of.h"
#include "temporary_folder.h"

namespace risorius::serve {
namespace {

const Page kPage{{"/", {"text/html", "page"}}, {"/studio.js", {"text/javascript", "code"}}};

Answer answer(const std::string& host, const std::string& origin = "",
              const std::string& target = "/", const std::string& method = "GET",
              bool upgrade = false) {
    return answer_to({method, target, host, origin, upgrade, true}, 8123, kPage);
}

TEST(RequestChecks, AnswerTheirOwnNamesAndPortOnly) {
    EXPECT_EQ(answer("127.0.0.1:8123"), Answer::kFile);
    EXPECT_EQ(answer("localhost:8123"), Answer::kFile);
    for (const char* host :
         {"", "127.0.0.1", "localhost", "127.0.0.1:8124", "127.0.0.1:81230", "127.0.0.1:812",
          "localhost:8123.evil.example", "evil.example:8123", "localhost:8123@evil.example",
          "xlocalhost:8123", "LOCALHOST:8123", " localhost:8123", "127.0.0.2:8123", "[::1]:8123"})
        EXPECT_EQ(answer(host), Answer::kForbidden) << host;
}

TEST(RequestChecks, RefuseOtherOrigins) {
    EXPECT_EQ(answer("localhost:8123", "http://localhost:8123"), Answer::kFile);
    for (const char* origin :
         {"null", "https://localhost:8123", "http://localhost:81234", "http://localhost",
          "http://localhost:8123.evil.example", "http://evil.example", "http://localhost:8123/",
          "http://evil.example/http://localhost:8123"})
        for (const char* target : {"/", "/socket"})
            EXPECT_EQ(answer("localhost:8123", origin, target, "GET", target[1] == 's'),
                      Answer::kForbidden)
                << origin;
}

TEST(RequestChecks, AWebSocketNeedsAnOrigin) {
    EXPECT_EQ(answer("localhost:8123", "", "/socket", "GET", true), Answer::kForbidden);
    EXPECT_EQ(answer("localhost:8123", "http://127.0.0.1:8123", "/socket", "GET", true),
              Answer::kSocket);
    EXPECT_EQ(answer("localhost:8123", "http://127.0.0.1:8123", "/socket"), Answer::kNotFound);
}

TEST(RequestChecks, ServeNamesOfATableAndNoPaths) {
    for (const char* target :
         {"/../etc/passwd", "/studio.js/..", "/%2e%2e/etc/passwd", "//", "/./", "/studio.js?x",
          "/studio.js%00", "studio.js", "", "/STUDIO.JS", "http://localhost:8123/", "/etc/passwd"})
        EXPECT_EQ(answer("localhost:8123", "", target), Answer::kNotFound) << target;
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", ""})
        EXPECT_EQ(answer("localhost:8123", "", "/", method), Answer::kNotAllowed) << method;
    EXPECT_EQ(answer("localhost:8123", "", "/studio.js", "HEAD"), Answer::kFile);
}

TEST(RequestChecks, TokensAreComparedAsAWhole) {
    const std::string token = new_token();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_TRUE(same_token(token, token));
    for (const std::string& given :
         {std::string(), token.substr(1), token + "0", token + token, std::string(32, '0')})
        EXPECT_FALSE(same_token(token, given)) << given;
    EXPECT_FALSE(same_token("", ""));
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) tokens.insert(new_token());
    EXPECT_EQ(tokens.size(), 100u);
}

TEST(RequestChecks, APageThatIsNotBuiltIsAnError) {
    const TemporaryFolder folder;
    EXPECT_NE(message_of([&] { read_page(folder.path().string()); }).find("index.html"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::serve
