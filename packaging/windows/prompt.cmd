@echo off
set "PATH=%~dp0;%PATH%"
bobdesk --help
