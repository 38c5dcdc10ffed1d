// SPDX-License-Identifier: Apache-2.0
// A server for the viewer and one stream, on the loopback interface alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "limber/base/result.h"

namespace limber::tool {

// Gives the page at / and the stream at /stream/ANY_NAME, a part of it where a request names one. Requests for
// another host's name are refused, so that no page of another site can read the stream through a name of its own.
class StreamServer {
 public:
  // `stream` must live as long as the server.
  StreamServer(std::string page, std::span<const std::byte> stream);
  ~StreamServer();

  // Gives the port; 0 asks for a free one. Error kIo: the port is taken, or not for this user.
  Result<std::uint16_t> bind(std::uint16_t port);

  // Answers until interrupted(). Precondition: bind() gave a port.
  void serve();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace limber::tool
