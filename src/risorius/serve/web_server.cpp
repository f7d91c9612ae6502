// SPDX-License-Identifier: MIT
#include "risorius/serve/web_server.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>  // Asio 1.74 forgets it in C++20

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"

namespace risorius::serve {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Code = beast::error_code;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kHeaderBytes = 8 << 10;
constexpr auto kHttpTime = std::chrono::seconds(10);
constexpr auto kTick = std::chrono::nanoseconds(1000000000 / 60);

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

struct WebServer::Impl {
    asio::io_context context{1};
    tcp::acceptor acceptor{context};
    asio::steady_timer timer{context};
    Page page;
    ServerLimits limits;
    std::string token = new_token();
    int port = 0;
    const Handler* handler = nullptr;
    std::function<bool()> stopped;
    int peers = 0;
    bool told = false;  ///< a message has come since it was asked last

    void accept();
    void tick(Clock::time_point due);
    void step(Clock::time_point due, int messages);
};

namespace {

/// A WebSocket. It becomes a peer when its first message has the token.
class Socket : public Peer, public std::enable_shared_from_this<Socket> {
  public:
    Socket(tcp::socket socket, WebServer::Impl& server)
        : stream_(std::move(socket)), server_(server), timer_(server.context) {}
    ~Socket() override { --server_.peers; }

    void start(const http::request<http::empty_body>& request) {
        ++server_.peers;
        if (server_.peers > server_.limits.peers) return;
        stream_.read_message_max(server_.limits.text_bytes);
        // In one piece: between pieces of 4 kB, 40 a pose, a step might come each time.
        stream_.auto_fragment(false);
        stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
        websocket::permessage_deflate no_compression;
        stream_.set_option(no_compression);
        stream_.async_accept(request, [self = shared_from_this()](Code failed) {
            if (failed) return;
            self->wait_for_hello();
            self->read();
        });
    }

    void send_text(std::string text) override {
        push({std::make_shared<const std::string>(std::move(text)), false});
    }
    void send_binary(std::shared_ptr<const std::string> bytes) override {
        push({std::move(bytes), true});
    }
    std::size_t waiting() const override { return queue_.size(); }
    void close() override { end(websocket::close_code::normal); }

  private:
    struct Message {
        std::shared_ptr<const std::string> bytes;
        bool binary;
    };

    void wait_for_hello() {
        timer_.expires_after(
            std::chrono::milliseconds(static_cast<long>(1000 * server_.limits.hello_s)));
        timer_.async_wait([self = shared_from_this()](Code cancelled) {
            if (!cancelled && !self->known_) self->end(websocket::close_code::policy_error);
        });
    }

    void read() {
        buffer_.clear();
        stream_.async_read(buffer_, [self = shared_from_this()](Code failed, std::size_t) {
            if (failed) {
                self->gone();
                return;
            }
            const bool text = self->stream_.got_text();
            const bool taken = text || (self->known_ && self->server_.handler->binary);
            if (!taken || !self->in_time()) {
                self->end(websocket::close_code::policy_error);
                return;
            }
            const std::string message = beast::buffers_to_string(self->buffer_.data());
            if (text)
                self->take(message);
            else
                self->server_.handler->binary(*self, message);
            if (!self->ending_) self->read();
        });
    }

    /// Whether there are not too many messages in this second.
    bool in_time() {
        const auto now = Clock::now();
        if (now - second_ > std::chrono::seconds(1)) {
            second_ = now;
            count_ = 0;
        }
        return ++count_ <= server_.limits.messages_per_s;
    }

    void take(const std::string& text) {
        server_.told = true;
        if (known_) {
            server_.handler->text(*this, text);
            return;
        }
        const Json hello = json_or_null(text);
        const auto field = [&](const char* key) {
            return hello.is_object() && hello.contains(key) && hello[key].is_string()
                       ? hello[key].get<std::string>()
                       : std::string();
        };
        if (field("type") != "hello" || !same_token(server_.token, field("token"))) {
            end(websocket::close_code::policy_error);
            return;
        }
        known_ = true;
        timer_.cancel();
        server_.handler->opened(*this);
    }

    void push(Message message) {
        if (ending_) return;
        queue_.push_back(std::move(message));
        if (queue_.size() == 1) write();
    }

    void write() {
        stream_.binary(queue_.front().binary);
        stream_.async_write(asio::buffer(*queue_.front().bytes),
                            [self = shared_from_this()](Code failed, std::size_t) {
                                if (failed) return;
                                self->queue_.pop_front();
                                if (!self->queue_.empty()) self->write();
                            });
    }

    void end(websocket::close_code code) {
        if (std::exchange(ending_, true)) return;
        gone();
        stream_.async_close(code, [self = shared_from_this()](Code) {});
    }

    void gone() {
        timer_.cancel();
        ending_ = true;
        if (std::exchange(known_, false)) server_.handler->closed(*this);
    }

    websocket::stream<beast::tcp_stream> stream_;
    WebServer::Impl& server_;
    asio::steady_timer timer_;
    beast::flat_buffer buffer_;
    std::deque<Message> queue_;
    bool known_ = false, ending_ = false;
    Clock::time_point second_ = Clock::now();
    int count_ = 0;
};

/// One request. The connection is closed behind its answer, or becomes a WebSocket.
class Visit : public std::enable_shared_from_this<Visit> {
  public:
    Visit(tcp::socket socket, WebServer::Impl& server)
        : stream_(std::move(socket)), server_(server) {
        parser_.header_limit(kHeaderBytes);
        parser_.body_limit(0);
    }

    void start() {
        stream_.expires_after(kHttpTime);
        http::async_read(stream_, buffer_, parser_,
                         [self = shared_from_this()](Code failed, std::size_t) {
                             if (!failed) self->answer();
                         });
    }

  private:
    void answer() {
        const auto& request = parser_.get();
        const RequestHead head{.method = view_of(request.method_string()),
                               .target = view_of(request.target()),
                               .host = view_of(request[http::field::host]),
                               .origin = view_of(request[http::field::origin]),
                               .upgrade = websocket::is_upgrade(request),
                               .one_of_each = request.count(http::field::host) == 1 &&
                                              request.count(http::field::origin) <= 1};
        const Answer answer = answer_to(head, server_.port, server_.page);
        switch (answer) {
            case Answer::kSocket:
                stream_.expires_never();
                std::make_shared<Socket>(stream_.release_socket(), server_)->start(request);
                return;
            case Answer::kFile: {
                const PageFile& file = server_.page.find(head.target)->second;
                send(http::status::ok, file.type, file.bytes, head.method == "HEAD");
                return;
            }
            case Answer::kForbidden:
                send(http::status::forbidden, "text/plain", "This is not a page of the studio.\n");
                return;
            case Answer::kNotAllowed:
                send(http::status::method_not_allowed, "text/plain", "GET only.\n");
                return;
            case Answer::kNotFound:
                send(http::status::not_found, "text/plain", "There is nothing of this name.\n");
        }
    }

    void send(http::status status, const std::string& type, const std::string& body,
              bool head_only = false) {
        response_ = {status, 11};
        response_.set(http::field::content_type, type);
        response_.set(http::field::cache_control, "no-store");
        response_.set("Content-Security-Policy", kContentPolicy);
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Referrer-Policy", "no-referrer");
        response_.set("Cross-Origin-Resource-Policy", "same-origin");
        response_.keep_alive(false);
        if (head_only)
            response_.content_length(body.size());
        else
            response_.body() = body;
        if (!head_only) response_.prepare_payload();
        http::async_write(stream_, response_, [self = shared_from_this()](Code, std::size_t) {
            Code ignored;
            self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
        });
    }

    beast::tcp_stream stream_;
    WebServer::Impl& server_;
    beast::flat_buffer buffer_;
    http::request_parser<http::empty_body> parser_;
    http::response<http::string_body> response_;
};

}  // namespace

void WebServer::Impl::accept() {
    acceptor.async_accept([this](Code failed, tcp::socket socket) {
        if (!acceptor.is_open()) return;
        if (!failed) {
            Code ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            std::make_shared<Visit>(std::move(socket), *this)->start();
        }
        accept();
    });
}

void WebServer::Impl::tick(Clock::time_point due) {
    timer.expires_at(due);
    timer.async_wait([this, due](Code failed) {
        if (!failed) step(due, 0);
    });
}

// Messages that wait go before a step, which may take longer than they; but not for ever.
void WebServer::Impl::step(Clock::time_point due, int messages) {
    constexpr int kMostMessages = 100;
    if (std::exchange(told, false) && messages < kMostMessages) {
        asio::post(context, [this, due, messages] { step(due, messages + 1); });
        return;
    }
    if (stopped()) {
        context.stop();
        return;
    }
    handler->tick();
    // What a slow step has missed is not made up for.
    tick(std::max(due + kTick, Clock::now() - 2 * kTick));
}

WebServer::WebServer(Page page, int port, const ServerLimits& limits)
    : impl_(std::make_unique<Impl>()) {
    impl_->page = std::move(page);
    impl_->limits = limits;
    const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
    Code failed;
    impl_->acceptor.open(here.protocol(), failed);
    if (!failed) impl_->acceptor.set_option(tcp::acceptor::reuse_address(true), failed);
    if (!failed) impl_->acceptor.bind(here, failed);
    if (!failed) impl_->acceptor.listen(asio::socket_base::max_listen_connections, failed);
    if (failed)
        throw Error(option_name("port"), "a port that is free",
                    std::to_string(port) + ": " + failed.message());
    impl_->port = impl_->acceptor.local_endpoint().port();
}

WebServer::~WebServer() = default;
int WebServer::port() const { return impl_->port; }
const std::string& WebServer::token() const { return impl_->token; }
std::string WebServer::url() const {
    return "http://127.0.0.1:" + std::to_string(impl_->port) + "/#" + impl_->token;
}

void WebServer::run(const Handler& handler, const std::function<bool()>& stopped) {
    impl_->handler = &handler;
    impl_->stopped = stopped;
    impl_->accept();
    impl_->tick(Clock::now());
    impl_->context.run();
    impl_->acceptor.close();
}

void WebServer::post(std::function<void()> what) { asio::post(impl_->context, std::move(what)); }

}  // namespace risorius::serve
