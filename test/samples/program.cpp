// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include <algorithm>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

namespace opencv_test {

namespace {

// A word that the shell passes on as it is.
std::string quoted(const std::string& word)
{
    std::string result = "'";
    for (char c : word)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

} // namespace

Outcome runCommand(const std::string& command)
{
    const TemporaryFolder folder;
    const std::string redirected =
        "{ " + command + "\n} >" + quoted(folder / "output") + " 2>" + quoted(folder / "messages") + " </dev/null";
    const int status = std::system(redirected.c_str());
    const bool exited = WIFEXITED(status) && WEXITSTATUS(status) < 126;
    return Outcome{exited ? WEXITSTATUS(status) : -1, contentOf(folder / "output"), contentOf(folder / "messages")};
}

Outcome runProgram(const std::string& program, const Arguments& arguments)
{
    std::string command = quoted(program);
    for (const std::string& argument : arguments)
        command += " " + quoted(argument);
    return runCommand(command);
}

RunningProgram::RunningProgram(const std::string& program, Arguments arguments) : process_(fork())
{
    if (process_ != 0)
        return;
    // What is started in the background of a shell, these tests for one, inherits that SIGINT is ignored.
    std::signal(SIGINT, SIG_DFL);
    arguments.insert(arguments.begin(), program);
    std::vector<char*> words;
    for (std::string& word : arguments)
        words.push_back(&word[0]);
    words.push_back(nullptr);
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, 1);
    dup2(nothing, 2);
    execv(words[0], words.data());
    _exit(127);
}

int RunningProgram::wait()
{
    int status = 0;
    wait4(process_, &status, 0, &usage_);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TemporaryFolder::TemporaryFolder()
{
    const char* base = std::getenv("TMPDIR");
    std::string name = std::string(base && *base ? base : "/tmp") + "/rsackermann-XXXXXX";
    if (!mkdtemp(&name[0]))
        throw std::runtime_error("no temporary folder can be made: " + name);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    cv::utils::fs::remove_all(path_);
}

double differenceInside(const cv::Mat& a, const cv::Mat& b)
{
    const int border = 20;
    const cv::Rect inside(border, border, a.cols - 2 * border, a.rows - 2 * border);
    return cv::norm(a(inside), b(inside), cv::NORM_L1) / double(inside.area() * a.channels());
}

std::vector<std::string> namesIn(const std::string& folder)
{
    std::vector<std::string> names;
    DIR* dir = opendir(folder.c_str());
    if (!dir)
        return names;
    while (const dirent* entry = readdir(dir))
        if (std::string(entry->d_name) != "." && std::string(entry->d_name) != "..")
            names.push_back(entry->d_name);
    closedir(dir);
    std::sort(names.begin(), names.end());
    return names;
}

std::string contentOf(const std::string& path)
{
    std::ifstream file(path.c_str(), std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

void writeContent(const std::string& path, const std::string& content)
{
    std::ofstream(path.c_str(), std::ios::binary) << content;
}

std::vector<std::string> linesOf(const std::string& path)
{
    std::vector<std::string> lines;
    std::ifstream file(path.c_str());
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

void cutShort(const std::string& from, const std::string& to, double share)
{
    const std::string content = contentOf(from);
    writeContent(to, content.substr(0, size_t(content.size() * share)));
}

const std::string& streetFolder()
{
    static const TemporaryFolder folder;
    static const Outcome outcome =
        simulate({"--output=" + folder.path() + "/street", "--speed=60", "--yaw_rate=40", "--seed=3"});
    if (outcome.exitCode != 0)
        throw std::runtime_error("rsackermann_simulate has failed: " + outcome.messages);
    static const std::string path = folder.path() + "/street";
    return path;
}

cv::Mat streetImage()
{
    return cv::imread(streetFolder() + "/rolling.png");
}

} // namespace opencv_test
