// Runs the fuzz target where there is no libFuzzer: files that are given, or random bytes for some seconds.
//
//     fuzz_points FILE…                what once went wrong, again
//     fuzz_points -max_total_time=60   random bytes; what goes wrong is left in the file fuzz-input

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run_file(const char* name) {
    std::ifstream file(name, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// Few or many bytes, all of one small range or of any value: small ranges make ties and repeated points.
std::vector<std::uint8_t> random_bytes(std::mt19937_64& random) {
    const std::size_t size = 1 + random() % (random() % 16 == 0 ? 2000 : 100);
    const std::uint64_t range = std::uint64_t{1} << (1 + random() % 8);
    std::vector<std::uint8_t> bytes(size);
    for (std::uint8_t& byte : bytes) {
        byte = static_cast<std::uint8_t>(random() % range);
    }
    bytes[0] = static_cast<std::uint8_t>(random());
    return bytes;
}

void run_for(double seconds) {
    std::mt19937_64 random(std::random_device{}());
    const auto begin = std::chrono::steady_clock::now();
    std::size_t runs = 0;
    for (; std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < seconds; ++runs) {
        const std::vector<std::uint8_t> bytes = random_bytes(random);
        // Written before the run, since a failed run does not come back.
        std::ofstream("fuzz-input", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    std::remove("fuzz-input");
    std::printf("%zu runs\n", runs);
}

}  // namespace

int main(int count, char** arguments) {
    constexpr char TIME[] = "-max_total_time=";
    for (int k = 1; k < count; ++k) {
        if (std::strncmp(arguments[k], TIME, sizeof TIME - 1) == 0) {
            run_for(std::atof(arguments[k] + sizeof TIME - 1));
        } else if (arguments[k][0] != '-' && !std::filesystem::is_directory(arguments[k])) {
            run_file(arguments[k]);
        }
    }
    return 0;
}
