@echo off
rem `course` is a program of Linux and macOS.
echo course: this is Windows; run the course in WSL: wsl --install, then clone and start it there 1>&2
exit /b 1
