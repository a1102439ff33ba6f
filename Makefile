all:
	@cmake -S . -B build -DCMAKE_BUILD_TYPE=Release >/dev/null && cmake --build build -j
