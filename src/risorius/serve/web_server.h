// SPDX-License-Identifier: MIT
/// \file
/// A small web server for one page on this computer: HTTP for the files of the page, and WebSockets for what it says.
///
/// It listens at 127.0.0.1 only. Everything runs on the thread of run(), so that handlers need no locks; post() is the one function that
/// other threads may call.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "risorius/serve/request_checks.h"

namespace risorius::serve {

/// The other end of a WebSocket that has given the token.
class Peer {
  public:
    virtual ~Peer() = default;
    virtual void send_text(std::string text) = 0;
    virtual void send_binary(std::shared_ptr<const std::string> bytes) = 0;
    virtual std::size_t waiting() const = 0;  ///< messages that have not been sent yet
    virtual void close() = 0;
};

/// What the server tells. `peer` is the same object for all messages of a connection.
struct Handler {
    std::function<void(Peer& peer)> opened;
    std::function<void(Peer& peer, const std::string& text)> text;
    /// Binary messages; empty: they close the connection
    std::function<void(Peer& peer, const std::string& bytes)> binary{};
    std::function<void(Peer& peer)> closed;
    std::function<void()> tick;  ///< every 1/60 s; what is late is left out
};

struct ServerLimits {
    std::size_t text_bytes = 1 << 20;  ///< of a message, binary ones too
    int messages_per_s = 400;          ///< of a connection; more close it
    double hello_s = 2;  ///< time for the first message, {"type": "hello", "token": ...}
    int peers = 8;       ///< connections at a time
};

class WebServer {
  public:
    /// `port`: 0 for any free one. Throws Error when it is not free.
    WebServer(Page page, int port, const ServerLimits& limits = {});
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    int port() const;
    const std::string& token() const;
    std::string url() const;  ///< with the token behind #, which browsers do not send

    /// Serves until `stopped` returns true; it is asked at every tick.
    void run(const Handler& handler, const std::function<bool()>& stopped);
    /// Does something on the thread of run().
    void post(std::function<void()> what);

    struct Impl;

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::serve
