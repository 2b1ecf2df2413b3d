# `cmake --install` and `cpack -G DEB`: programs in lib/coop (coop_node() and launcher/ put them there), the front door in
# bin, configuration and maps in share/coop, where the launcher looks for them.
install(PROGRAMS coop DESTINATION bin)
# The verbs that build and test stay with the sources.
install(DIRECTORY launcher/verbs/ DESTINATION share/coop/verbs REGEX "/(build|test|maintain)\\.sh$" EXCLUDE)
install(DIRECTORY config maps DESTINATION share/coop)
install(FILES README.md DESTINATION share/doc/coop OPTIONAL)
install(DIRECTORY docs/ DESTINATION share/doc/coop OPTIONAL FILES_MATCHING PATTERN "*.md" PATTERN "*.png")

# The service: unit, user and folders, and its launch files, which are the owner's to change.
install(FILES systemd/coop@.service DESTINATION lib/systemd/system)
install(FILES systemd/coop.sysusers DESTINATION lib/sysusers.d RENAME coop.conf)
install(FILES systemd/coop.tmpfiles DESTINATION lib/tmpfiles.d RENAME coop.conf)
install(FILES systemd/etc/sim.yaml systemd/etc/collect.yaml DESTINATION share/coop/etc)
install(CODE [[
  # Of a package alone: an installation into some other folder leaves the machine's /etc as it is.
  if(CMAKE_INSTALL_PREFIX MATCHES "^(.*)/usr$")
    file(INSTALL "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share/coop/etc/" DESTINATION "${CMAKE_MATCH_1}/etc/coop")
  endif()
]])
install(FILES docker/compose.yaml docker/host.yaml docker/security.yaml docker/hardware.yaml docker/dashboard.yaml
  DESTINATION share/doc/coop/docker)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME coop)
set(CPACK_PACKAGE_VENDOR "Coop")
set(CPACK_PACKAGE_CONTACT "The Coop authors <coop@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "DDS components for robots that work in barns")
set(CPACK_PACKAGE_DESCRIPTION "Mapping, localisation, planning, driving and picking as separate programs over Fast DDS,
composed into a robot by a YAML launch file, with a simulator that stands in for the robot and its barn.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS bash)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/systemd/conffiles" "${PROJECT_SOURCE_DIR}/systemd/postinst"
  "${PROJECT_SOURCE_DIR}/systemd/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
