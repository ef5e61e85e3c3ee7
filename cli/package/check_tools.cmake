# CPack reads this first. Without dpkg-shlibdeps it would make a package that depends on no library, and only say so.
find_program(dpkg_shlibdeps dpkg-shlibdeps)
if(NOT dpkg_shlibdeps)
  message(FATAL_ERROR "dpkg-shlibdeps is missing; install dpkg-dev")
endif()
