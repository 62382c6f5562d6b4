// The replay page of a run, possibly in progress, served to browsers on this computer.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "results/files.hpp"
#include "view/view_run.hpp"

namespace edda {

/// Serves the page at http://127.0.0.1:PORT/ until `stop`: the page itself, the run's header
/// ("run"), its mesh, datums, frames and tables ("chunk/NAME", deflated). Frames are read when they
/// are asked for. Where there is nothing to show yet, the header is {"waiting": why} and a
/// chunk is status 204. `open`: the folder's run; called again where there is none yet, or another
/// one than before. `port` 0: any that is free. `ready` is called with the address once it answers.
Trouble serve_page(const std::function<Result<ViewRun>()>& open, int port,
                   const std::function<void(const std::string&)>& ready,
                   const std::atomic<bool>& stop);

}  // namespace edda
