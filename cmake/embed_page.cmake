# Writes the replay page into a .cpp, in two parts: before and behind its mark <!--RUN-->, where a run goes in.
function(embed_page page output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  file(READ ${page} html)
  string(FIND "${html}" "<!--RUN-->" at)
  if(at LESS 0)
    message(FATAL_ERROR "${page} has no mark <!--RUN-->")
  endif()
  string(SUBSTRING "${html}" 0 ${at} head)
  math(EXPR behind "${at} + 10")
  string(SUBSTRING "${html}" ${behind} -1 tail)
  file(CONFIGURE OUTPUT ${output} CONTENT [[#include "view/page.hpp"

edda::PageTemplate edda::page_template() {
  return {R"replay-page(@head@)replay-page", R"replay-page(@tail@)replay-page"};
}
]] @ONLY)
endfunction()
