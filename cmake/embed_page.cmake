# PAGE -> OUTPUT, a .cpp with the page before and behind its mark <!--RUN-->.
file(READ ${PAGE} html)
string(FIND "${html}" "<!--RUN-->" at)
if(at LESS 0)
  message(FATAL_ERROR "${PAGE} has no mark <!--RUN-->")
endif()
string(SUBSTRING "${html}" 0 ${at} head)
math(EXPR behind "${at} + 10")
string(SUBSTRING "${html}" ${behind} -1 tail)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[#include "view/page.hpp"

edda::PageTemplate edda::page_template() {
  return {R"replay-page(@head@)replay-page", R"replay-page(@tail@)replay-page"};
}
]] @ONLY)
