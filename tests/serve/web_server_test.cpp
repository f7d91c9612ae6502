// SPDX-License-Identifier: MIT
// The server under attack: what comes over real sockets of this computer.
#include "risorius/serve/web_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <thread>
#include <utility>  // Asio 1.74 forgets it in C++20

#include "message_of.h"

namespace risorius::serve {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

/// A server that repeats what it is told.
class Echo {
  public:
    Echo()
        : server_(Page{{"/", {"text/html; charset=utf-8", "<p>page"}}}, 0,
                  {.text_bytes = 1000, .messages_per_s = 50, .hello_s = 0.2}),
          thread_([this] {
              server_.run({.opened = [this](Peer&) { ++opened; },
                           .text =
                               [](Peer& peer, const std::string& text) {
                                   peer.send_text(text);
                                   peer.send_binary(std::make_shared<std::string>("\x01\x02"));
                               },
                           .closed = [this](Peer&) { ++closed; },
                           .tick = [this] { ++ticks; }},
                          [this] { return stop.load(); });
          }) {}
    ~Echo() {
        stop = true;
        thread_.join();
    }
    const WebServer& server() const { return server_; }
    std::string host() const { return "127.0.0.1:" + std::to_string(server_.port()); }

    std::atomic<int> opened{0}, closed{0}, ticks{0};
    std::atomic<bool> stop{false};

  private:
    WebServer server_;
    std::thread thread_;
};

tcp::socket connected(asio::io_context& context, int port) {
    tcp::socket socket(context);
    socket.connect({asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)});
    return socket;
}

/// What the server answers to bytes, until it closes the connection.
std::string answer_to_bytes(const Echo& echo, const std::string& bytes) {
    asio::io_context context;
    tcp::socket socket = connected(context, echo.server().port());
    beast::error_code failed;
    asio::write(socket, asio::buffer(bytes), failed);
    std::string out;
    asio::read(socket, asio::dynamic_buffer(out), failed);
    return out;
}

class Client {
  public:
    explicit Client(const Echo& echo, const std::string& origin = "")
        : stream_(connected(context_, echo.server().port())) {
        const std::string from = origin.empty() ? "http://" + echo.host() : origin;
        stream_.set_option(
            websocket::stream_base::decorator([from](websocket::request_type& request) {
                request.set(beast::http::field::origin, from);
            }));
        stream_.handshake(echo.host(), "/socket", failed);
    }
    void send(const std::string& text, bool binary = false) {
        stream_.binary(binary);
        stream_.write(asio::buffer(text), failed);
    }
    std::string receive() {
        beast::flat_buffer buffer;
        stream_.read(buffer, failed);
        return beast::buffers_to_string(buffer.data());
    }
    void hello(const std::string& token) {
        send("{\"type\": \"hello\", \"token\": \"" + token + "\", \"protocol\": 1}");
    }
    beast::error_code failed;

  private:
    asio::io_context context_;
    websocket::stream<tcp::socket> stream_;
};

TEST(WebServer, ServesThePageWithItsPolicy) {
    const Echo echo;
    const std::string answer =
        answer_to_bytes(echo, "GET / HTTP/1.1\r\nHost: " + echo.host() + "\r\n\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
    EXPECT_TRUE(answer.ends_with("<p>page"));
    for (const char* part :
         {"Content-Security-Policy: default-src 'self'; script-src 'self' 'wasm-unsafe-eval'",
          "frame-ancestors 'none'", "object-src 'none'", "X-Content-Type-Options: nosniff"})
        EXPECT_NE(answer.find(part), std::string::npos) << part;
    EXPECT_EQ(answer.find("Access-Control"), std::string::npos);
    EXPECT_EQ(answer.find(echo.server().token()), std::string::npos);
    EXPECT_EQ(echo.server().url(), "http://" + echo.host() + "/#" + echo.server().token());
}

TEST(WebServer, RefusesRequestsThatAreNotOfThePage) {
    const Echo echo;
    const auto status = [&](const std::string& line, const std::string& headers) {
        const std::string answer = answer_to_bytes(echo, line + " HTTP/1.1\r\n" + headers + "\r\n");
        return answer.size() < 12 ? answer : answer.substr(9, 3);
    };
    const std::string host = "Host: " + echo.host() + "\r\n";
    EXPECT_EQ(status("GET /", ""), "403");
    EXPECT_EQ(status("GET /", "Host: evil.example\r\n"), "403");
    EXPECT_EQ(status("GET /", host + host), "403");
    EXPECT_EQ(status("GET /", host + "Origin: http://evil.example\r\n"), "403");
    EXPECT_EQ(status("GET /../../etc/passwd", host), "404");
    EXPECT_EQ(status("POST /", host + "Content-Length: 0\r\n"), "405");
    EXPECT_EQ(status("POST /", host + "Content-Length: 99999999\r\n"), "");
    EXPECT_EQ(status("GET /", host + "X: " + std::string(20000, 'x') + "\r\n"), "");
    EXPECT_EQ(answer_to_bytes(echo, "\x16\x03\x01 nonsense\r\n\r\n"), "");
}

TEST(WebServer, TalksToWhoHasTheToken) {
    const Echo echo;
    Client client(echo);
    ASSERT_FALSE(client.failed);
    client.hello(echo.server().token());
    client.send("{\"a\": 1}");
    EXPECT_EQ(client.receive(), "{\"a\": 1}");
    EXPECT_EQ(client.receive(), "\x01\x02");
    EXPECT_EQ(echo.opened, 1);
    EXPECT_GT(echo.ticks, 0);
}

TEST(WebServer, ClosesOnWhoHasNot) {
    const Echo echo;
    for (const std::string& hello :
         {std::string("{\"type\": \"hello\", \"token\": \"00\"}"),
          std::string("{\"type\": \"hello\"}"), std::string("{"), std::string("[[[["),
          std::string("\"" + echo.server().token() + "\""),
          "{\"type\": \"hallo\", \"token\": \"" + echo.server().token() + "\"}"}) {
        Client client(echo);
        client.send(hello);
        client.receive();
        EXPECT_EQ(client.failed, websocket::error::closed) << hello;
    }
    Client silent(echo);
    silent.receive();  // until the server loses patience
    EXPECT_EQ(silent.failed, websocket::error::closed);
    EXPECT_EQ(Client(echo, "http://evil.example").failed, websocket::error::upgrade_declined);
    EXPECT_EQ(echo.opened, 0);
}

TEST(WebServer, ClosesOnTooMuchAndTooOften) {
    const Echo echo;
    Client large(echo);
    large.hello(echo.server().token());
    large.send(std::string(1001, 'x'));
    large.receive();
    EXPECT_TRUE(large.failed);
    Client binary(echo);
    binary.hello(echo.server().token());
    binary.send("\x01\x02\x03", true);
    binary.receive();
    EXPECT_TRUE(binary.failed);
    Client often(echo);
    often.hello(echo.server().token());
    for (int i = 0; i < 60 && !often.failed; ++i) often.send("{}");
    for (int i = 0; i < 130 && !often.failed; ++i) often.receive();
    EXPECT_TRUE(often.failed);
    EXPECT_EQ(echo.opened, 3);
    // The server is still there.
    Client good(echo);
    good.hello(echo.server().token());
    good.send("{}");
    EXPECT_EQ(good.receive(), "{}");
}

TEST(WebServer, APortThatIsTakenIsAnError) {
    const Echo echo;
    const int port = echo.server().port();
    EXPECT_EQ(message_of([&] { WebServer(Page{}, port); }),
              "port: expected a port that is free, found " + std::to_string(port) +
                  ": Address already in use");
}

}  // namespace
}  // namespace risorius::serve
