#include "view/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "results/deflate.hpp"
#include "results/json.hpp"
#include "view/bytes.hpp"
#include "view/page.hpp"

namespace edda {
namespace {

constexpr const char* this_machine = "127.0.0.1";

/// Refuses requests with another host name, as a page of another site sends whose name was made to
/// resolve to this computer (DNS rebinding).
bool is_this_machine(const std::string& host) {
  const std::size_t port = host.rfind(':');
  const bool has_port = port != std::string::npos && !host.ends_with(']');
  const std::string name = has_port ? host.substr(0, port) : host;
  return name == this_machine || name == "localhost" || name == "[::1]";
}

/// Answers one at a time: taking up a frame changes the run.
class Answers {
 public:
  explicit Answers(const std::function<Result<ViewRun>()>& open) : open_(open) {}

  void page(httplib::Response& reply) {
    reply.set_content(std::string(page_template().head) + std::string(page_template().tail),
                      "text/html");
  }

  void header(httplib::Response& reply) {
    const std::lock_guard lock(busy_);
    if (const Trouble trouble = take_up_new()) {
      if (!is_for_now(*trouble)) return fail(reply, *trouble);
      const std::string waiting = to_string(*trouble);
      return reply.set_content(Json().open_object().pair("waiting", waiting).close().text(),
                               "application/json");
    }
    reply.set_content(run_->header(name_of_run()), "application/json");
  }

  /// `run`: as in the header that the page has; nothing where that run has gone.
  void named(const std::string& name, const std::string& run, httplib::Response& reply) {
    const std::lock_guard lock(busy_);
    if (!run_ || !run_->is_still_there() || run != name_of_run()) return gone(reply);
    if (name == "mesh") return give(mesh_bytes(run_->mesh()), reply);
    if (const auto k = number_after("datum-", name, run_->datums().size()))
      return give(datum_bytes(run_->mesh(), run_->datums()[*k]), reply);
    if (const auto k = number_after("frame-", name, run_->frames())) {
      const Result<std::string> frame = run_->again(*k, ViewPrecision::single);
      if (frame.ok()) return give(frame.value(), reply);
      const Fault& fault = frame.faults().front();
      return is_for_now(fault) ? gone(reply) : fail(reply, fault);
    }
    if (std::find(std::begin(view_tables), std::end(view_tables), name) != std::end(view_tables)) {
      // None yet: an empty answer, which is not an error for the page.
      return give(run_->table(name, most_table_rows), reply);
    }
    reply.status = 404;
  }

 private:
  std::string name_of_run() const { return fmt::format("{}{}", run_->stamp(), opened_); }

  /// Frames that have been added since, of the present run.
  Trouble take_up_new() {
    if (run_ && !run_->is_still_there()) run_.reset();
    if (!run_) {
      Result<ViewRun> run = open_();
      if (!run.ok()) return run.faults().front();
      run_ = std::move(run.value());
      ++opened_;
    }
    const Result<std::vector<SeriesEntry>> series = run_->series();
    if (!series.ok()) return series.faults().front();
    for (std::size_t k = run_->frames(); k < series.value().size(); ++k) {
      const Result<std::string> frame = run_->take(series.value()[k], ViewPrecision::whole16);
      if (!frame.ok()) return frame.faults().front();
    }
    return {};
  }

  /// While a run begins or is cleared, file by file, there is nothing to show. That is no error,
  /// which browsers would log each time.
  bool is_for_now(const Fault& fault) const {
    return !run_ || !run_->is_still_there() || !std::filesystem::exists(fault.where.file);
  }

  static std::optional<std::size_t> number_after(const std::string& prefix, const std::string& name,
                                                 std::size_t end) {
    if (!name.starts_with(prefix)) return {};
    const std::string digits = name.substr(prefix.size());
    if (digits.empty() || digits.size() > 9 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
      return {};
    const std::size_t k = std::stoul(digits);
    if (k >= end) return {};
    return k;
  }

  static void give(const std::string& bytes, httplib::Response& reply) {
    reply.set_content(deflated(bytes), "application/octet-stream");
  }
  static void gone(httplib::Response& reply) { reply.status = 204; }
  static void fail(httplib::Response& reply, const Fault& fault) {
    reply.status = 500;
    reply.set_content(to_string(fault), "text/plain");
  }

  const std::function<Result<ViewRun>()>& open_;
  std::optional<ViewRun> run_;
  std::size_t opened_ = 0;  ///< how often
  std::mutex busy_;
};

}  // namespace

Trouble serve_page(const std::function<Result<ViewRun>()>& open, int port,
                   const std::function<void(const std::string&)>& ready,
                   const std::atomic<bool>& stop) {
  Answers answers(open);
  httplib::Server server;
  // Without SO_REUSEPORT, with which two servers would share a port and its requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& reply) {
    if (is_this_machine(request.get_header_value("Host")))
      return httplib::Server::HandlerResponse::Unhandled;
    reply.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_default_headers({{"Cache-Control", "no-store"}});
  server.Get("/", [&](const httplib::Request&, httplib::Response& r) { answers.page(r); });
  server.Get("/run", [&](const httplib::Request&, httplib::Response& r) { answers.header(r); });
  server.Get(R"(/chunk/([\w.-]+))", [&](const httplib::Request& request, httplib::Response& r) {
    answers.named(request.matches[1], request.get_param_value("run"), r);
  });
  const int bound = port == 0 ? server.bind_to_any_port(this_machine)
                    : server.bind_to_port(this_machine, port) ? port
                                                              : -1;
  if (bound < 0) {
    Fault fault;
    fault.where.key = "--port";
    fault.problem = fmt::format("port {} is taken, or not allowed", port);
    fault.remedy = "give another one, or 0 for any that is free";
    return fault;
  }
  ready(fmt::format("http://{}:{}/", this_machine, bound));
  std::atomic<bool> over{false};
  // stop() has no effect on a server that does not listen yet.
  std::thread watch([&] {
    while (!over) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (stop) server.stop();
    }
  });
  server.listen_after_bind();
  over = true;
  watch.join();
  return {};
}

}  // namespace edda
