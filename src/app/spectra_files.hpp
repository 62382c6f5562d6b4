// The tables and pictures of edda spectra.
#pragma once

#include "app/spectra_source.hpp"
#include "results/files.hpp"

namespace edda {

/// Writes them into args.output, which may be a folder of earlier ones, but not of a run.
Trouble write_spectra(const Spectra& spectra, const SpectraArguments& args);

}  // namespace edda
