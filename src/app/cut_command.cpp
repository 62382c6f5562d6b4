#include "app/commands.hpp"
namespace edda {
void add_cut(CLI::App&, int&) {}
void add_plot(CLI::App&, int&) {}
}  // namespace edda
