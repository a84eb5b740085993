// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace opencv_test { namespace {

// What a program writes to a terminal that is its standard error.
std::string writtenToTerminal(Arguments command, int& exitCode)
{
    int master = -1;
    const pid_t child = forkpty(&master, nullptr, nullptr, nullptr);
    if (child == 0)
    {
        std::vector<char*> words;
        for (std::string& word : command)
            words.push_back(&word[0]);
        words.push_back(nullptr);
        execv(words[0], words.data());
        _exit(127);
    }
    std::string text;
    char buffer[4096];
    // Reading fails when the other end is closed.
    for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0;)
        text.append(buffer, size_t(n));
    int status = 0;
    waitpid(child, &status, 0);
    close(master);
    exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return text;
}

std::string repeated(const std::string& line, int times)
{
    std::string lines;
    for (int i = 0; i < times; i++)
        lines += line;
    return lines;
}

TEST(Progress, one_line_on_a_terminal)
{
    // So many images that it takes some three seconds, wherever it runs: a line is shown after one.
    const TemporaryFolder folder;
    const int some = 50;
    writeContent(folder / "some.txt", repeated(streetFolder() + "/rolling.png\n", some));
    const int64 start = cv::getTickCount();
    EXPECT_EQ(0, correct({"@" + (folder / "some.txt"), "--report=" + (folder / "some.jsonl")}).exitCode);
    const double seconds = double(cv::getTickCount() - start) / cv::getTickFrequency();
    const int count = some + int(some * 3 / seconds);
    writeContent(folder / "list.txt",
                 repeated(streetFolder() + "/rolling.png\n", count) + (folder / "missing.png") + "\n");
    const Arguments arguments = {"@" + (folder / "list.txt"), "--report=" + (folder / "report.jsonl")};

    int exitCode = 0;
    Arguments command = {CORRECT_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const std::string text = writtenToTerminal(command, exitCode);
    EXPECT_EQ(1, exitCode);
    EXPECT_NE(std::string::npos, text.find(" %, ")) << text;
    EXPECT_NE(std::string::npos, text.find(" left, ")) << text;
    // Only the message about the missing file ends its line, and it has the line for itself.
    const size_t end = text.find('\n');
    EXPECT_EQ(text.size() - 1, end) << text;
    const size_t message = text.find("rsackermann_correct: ");
    ASSERT_NE(std::string::npos, message);
    EXPECT_EQ("\r\x1b[K", text.substr(message - 4, 4));

    const Outcome quiet = correct({arguments[0], arguments[1], "--overwrite"});
    EXPECT_EQ(1, quiet.exitCode);
    EXPECT_EQ(std::string::npos, quiet.messages.find('%')) << quiet.messages;
    EXPECT_EQ(1, std::count(quiet.messages.begin(), quiet.messages.end(), '\n')) << quiet.messages;
}

}} // namespace
