// What the C++ peers share: reading points, the conversation with benchmarks/processes.py, time and peak memory.
//
// The program is started with the name of a file of doubles. It says when it is ready; for each line "run K" it
// triangulates K times and answers with one line of JSON. So the benchmark can take turns between engines that all
// keep their points in memory.
#pragma once

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace peer {

struct Counts {
    std::size_t points = 0;     // that became vertices
    std::size_t triangles = 0;
};

inline std::vector<double> read_doubles(const char* name) {
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

// High-water mark of resident memory, bytes.
inline long high_water() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stol(line.substr(6));
    return 0;
}

// Lowers the high-water mark to what is resident now, so that reading the input does not count.
inline void lower_high_water() { std::ofstream("/proc/self/clear_refs") << "5"; }

// Answers every "run K" with the seconds of K calls of `triangulate`, which returns a finished triangulation; its
// destruction is not timed.
template <class Triangulate, class Count>
int converse(const char* version, Triangulate triangulate, Count count) {
    std::printf("{\"version\": \"%s\"}\n", version);
    std::fflush(stdout);
    for (std::string command; std::getline(std::cin, command) && command.rfind("run ", 0) == 0;) {
        lower_high_water();
        const long before = high_water();
        Counts counts;
        std::string seconds;
        for (long repetition = std::stol(command.substr(4)); repetition > 0; --repetition) {
            const auto begin = std::chrono::steady_clock::now();
            const auto triangulation = triangulate();
            const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
            seconds += (seconds.empty() ? "" : ", ") + std::to_string(elapsed.count() * 1e6) + "e-6";
            counts = count(*triangulation);
        }
        std::printf("{\"seconds\": [%s], \"points\": %zu, \"triangles\": %zu, \"peak\": %ld}\n", seconds.c_str(),
                    counts.points, counts.triangles, high_water() - before);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace peer
