// SPDX-License-Identifier: Apache-2.0
#include "tool/stream_server.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <httplib.h>
#include <thread>
#include <utility>

#include "tool/interrupt.h"

namespace limber::tool {
namespace {

constexpr char kLoopback[] = "127.0.0.1";

struct Part {
  std::size_t begin = 0, length = 0;
};

// What a range of a request means for a stream of this size; length 0 where it means nothing.
Part part_of(const httplib::Range& range, std::size_t size) {
  const auto end = static_cast<ssize_t>(size);
  const auto [first, last] = range;
  if (first < 0) {  // the last so many bytes
    const ssize_t length = std::clamp<ssize_t>(last, 0, end);
    return {static_cast<std::size_t>(end - length), static_cast<std::size_t>(length)};
  }
  if (first >= end || (last >= 0 && last < first)) return {};
  const ssize_t beyond = last < 0 ? end : std::min<ssize_t>(last, end - 1) + 1;
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(beyond - first)};
}

}  // namespace

struct StreamServer::Server {
  std::string page;
  std::span<const std::byte> stream;
  httplib::Server http;
  std::uint16_t port = 0;

  void give_stream(const httplib::Request& request, httplib::Response& response) const;
  bool is_for_us(const httplib::Request& request) const;
};

// One range is answered here; several, which nothing asks for, with the whole. The library would take a range that ends
// beyond the stream at its word, and must not see it.
void StreamServer::Server::give_stream(const httplib::Request& request, httplib::Response& response) const {
  const httplib::Ranges ranges = request.ranges;
  const_cast<httplib::Request&>(request).ranges.clear();
  Part part{0, stream.size()};
  if (ranges.size() == 1) {
    part = part_of(ranges[0], stream.size());
    response.status = part.length > 0 ? 206 : 416;
    response.set_header("Content-Range", part.length > 0 ? fmt::format("bytes {}-{}/{}", part.begin,
                                                                       part.begin + part.length - 1, stream.size())
                                                         : fmt::format("bytes */{}", stream.size()));
  }
  response.set_header("Accept-Ranges", "bytes");
  response.set_header("Cache-Control", "no-store");
  if (part.length == 0) return;
  response.set_content_provider(part.length, "application/octet-stream",
                                [this, part](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  const std::byte* from = stream.data() + part.begin + offset;
                                  return sink.write(reinterpret_cast<const char*>(from), length);
                                });
}

bool StreamServer::Server::is_for_us(const httplib::Request& request) const {
  const std::string host = request.get_header_value("Host");
  return host == fmt::format("{}:{}", kLoopback, port) || host == fmt::format("localhost:{}", port);
}

StreamServer::StreamServer(std::string page, std::span<const std::byte> stream) : server_(std::make_unique<Server>()) {
  Server& server = *server_;
  server.page = std::move(page);
  server.stream = stream;
  server.http.set_pre_routing_handler([&server](const httplib::Request& request, httplib::Response& response) {
    if (server.is_for_us(request)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 421;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.http.Get("/", [&server](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(server.page, "text/html; charset=utf-8");
  });
  server.http.Get("/stream/.*", [&server](const httplib::Request& request, httplib::Response& response) {
    server.give_stream(request, response);
  });
}

StreamServer::~StreamServer() = default;

Result<std::uint16_t> StreamServer::bind(std::uint16_t port) {
  const int bound = port == 0 ? server_->http.bind_to_any_port(kLoopback)
                              : (server_->http.bind_to_port(kLoopback, port) ? int{port} : -1);
  if (bound <= 0)
    return Error{ErrorCode::kIo, fmt::format("port {}", port),
                 "cannot be had; leave out --port, and a free one is found"};
  server_->port = static_cast<std::uint16_t>(bound);
  return server_->port;
}

void StreamServer::serve() {
  std::thread answering([this] { server_->http.listen_after_bind(); });
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server_->http.stop();
  answering.join();
}

}  // namespace limber::tool
