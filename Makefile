# The few commands that a person needs.

EMBREE_VERSION = 4.4.0.post1

.PHONY: test test-nightly test-huge test-arm memcheck fuzz bench bench-kernel figures pictures schema

# Everything that can be checked: format, lints, tests, examples in the documentation, and that it builds.
test:
	@rustup component add rustfmt clippy 2>/dev/null || true
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked -- -D warnings
	cargo test --workspace --locked
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

# The ray kernel at length: 10 million random rays on random scenes, 100 million at the edges of closed surfaces.
test-nightly:
	PROPTEST_CASES=52500 cargo test --release --locked -p eyebeam-bvh --test properties
	EYEBEAM_RAYS=100000000 cargo test --release --locked -p eyebeam-bvh --test rays no_ray_gets_through_an_edge

# A hundred million triangles and ten million instances, one after the other: 12 GB of memory.
test-huge:
	cargo test --release --locked -p eyebeam-bvh --test huge -- --ignored --nocapture --test-threads 1

# The ray kernel with the instructions of ARM, on an emulated processor. Without the tools it says so and ends well.
ARM := aarch64-unknown-linux-gnu
test-arm:
	@if command -v aarch64-linux-gnu-gcc >/dev/null && command -v qemu-aarch64 >/dev/null \
		&& { ! command -v rustup >/dev/null || rustup target add $(ARM); }; then \
		set -x; \
		CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
		CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER="qemu-aarch64 -L /usr/aarch64-linux-gnu" \
		PROPTEST_CASES=50 \
		cargo test --locked -p eyebeam-bvh --target $(ARM) --lib --test memory --test properties; \
	else \
		echo "test-arm: SKIPPED. It needs the Debian packages gcc-aarch64-linux-gnu, libc6-dev-arm64-cross and qemu-user," \
			"and Rust's target $(ARM)."; \
	fi

# The unsafe code of the ray kernel under valgrind: every access to memory is checked. Without valgrind it says so.
VALGRIND := valgrind --quiet --error-exitcode=9 --leak-check=no --fair-sched=try
memcheck:
	@if command -v valgrind >/dev/null; then \
		cargo test --locked -p eyebeam-bvh --test memory --config "target.'cfg(unix)'.runner='$(VALGRIND)'" -- --nocapture; \
	else \
		echo "memcheck: SKIPPED. It needs valgrind."; \
	fi

# Random bytes as what TARGET says (a file in fuzz/fuzz_targets), for five minutes: a nightly compiler and `cargo install cargo-fuzz`.
# It begins with the small files of crates/io/tests/hostile, and goes on from what it found before, in fuzz/corpus.
TARGET ?= kernel
FUZZ_SECONDS ?= 300
fuzz:
	EYEBEAM_SEEDS=$(CURDIR)/fuzz/corpus cargo test --locked -p eyebeam-io --test hostile fuzzing_begins_with_them
	@mkdir -p fuzz/corpus/$(TARGET)
	cargo +nightly fuzz run -O $(TARGET) -- -max_total_time=$(FUZZ_SECONDS) -rss_limit_mb=2048 \
		$(if $(filter kernel,$(TARGET)),-timeout=10 -max_len=1024 -len_control=0,-timeout=5 -max_len=65536)

# Speed, and the comparison with a textbook program (docs/performance.md).
bench:
	cargo bench -p eyebeam-bench

# The ray kernel against Embree, which is unpacked to target/embree if it can be had; otherwise its columns stay empty.
bench-kernel:
	@ls target/embree/embreex*/libembree4*.so* >/dev/null 2>&1 || { \
		mkdir -p target/embree \
		&& python3 -m pip download --quiet --no-deps embreex==$(EMBREE_VERSION) -d target/embree \
		&& python3 -m zipfile -e target/embree/embreex-$(EMBREE_VERSION)-*.whl target/embree; \
	} || echo "Embree could not be fetched: going on without it" >&2
	cargo run --release --locked -p eyebeam-bench -- kernel $(ARGS)

# Other renderers on the same scenes. Drivers, references and scenes come from a folder beside the repository; what is
# installed goes to a scratch folder, 3 GB in all. What cannot be installed is left out.
PEERS_SHARED ?= ../shared
PEERS_SCRATCH ?= target/peers
PEERS_PYTHON = $(PEERS_SCRATCH)/mi/bin/python
PEERS_INSTALLS = mi:mitsuba==3.9.1,numpy,pillow blender:bpy==4.5.15 lux:pyluxcore==2.11.2,numpy

.PHONY: bench-peers agree-peers peers-setup
peers-setup:
	@test -d $(PEERS_SHARED)/peers || { echo "peers: there is no folder $(PEERS_SHARED)/peers" >&2; exit 1; }
	@for install in $(PEERS_INSTALLS); do \
		folder=$(PEERS_SCRATCH)/$${install%%:*}; packages=$$(echo $${install#*:} | tr , ' '); \
		test -e $$folder/installed && continue; \
		{ python3 -m venv $$folder && $$folder/bin/pip install --quiet $$packages && touch $$folder/installed; } \
			|| { rm -rf $$folder; echo "peers: $$packages could not be installed: left out" >&2; }; \
	done
	$(PEERS_PYTHON) bench/peers/write_scenes.py $(PEERS_SHARED)/peers $(PEERS_SCRATCH)
	$(PEERS_PYTHON) bench/peers/bitterli.py $(PEERS_SHARED)/scenes/mitsuba/bitterli/cornell-box $(PEERS_SCRATCH)
	cargo build --release --locked -p eyebeam-bench

# Seconds times error beside Mitsuba, Cycles and LuxCore.
bench-peers: peers-setup
	$(PEERS_PYTHON) bench/peers/compare.py --eyebeam target/release/eyebeam-bench --shared $(PEERS_SHARED)/peers \
		--scratch $(PEERS_SCRATCH) $(ARGS)

# Seconds to read a model and build its hierarchy, beside Mitsuba and Cycles.
.PHONY: bench-load
bench-load: peers-setup
	cargo build --release --locked
	$(PEERS_PYTHON) bench/peers/load.py --helmet $(PEERS_SHARED)/scenes/gltf/DamagedHelmet/glTF-Binary/DamagedHelmet.glb \
		--scratch $(PEERS_SCRATCH) $(ARGS)

# Whether our pictures are those of the references: means, offsets, blocks.
agree-peers: peers-setup
	$(PEERS_PYTHON) bench/peers/agree.py --renderer target/release/eyebeam-bench --scenes $(PEERS_SCRATCH)/scenes \
		--references $(PEERS_SCRATCH)/ref --info $(PEERS_SHARED)/peers/ref/info.json $(ARGS)

# The study: pictures and numbers (docs/figures).
figures:
	cargo run --release -- figures paper -o docs/figures

# The figures of the pages about materials and textures (docs/materials, docs/textures): a quarter of an hour on two cores.
.PHONY: figures-materials
figures-materials:
	cargo build --release --locked
	python3 -B docs/materials/figures.py --eyebeam target/release/eyebeam

# The pictures in the README.
pictures:
	mkdir -p docs/pictures
	cargo run --release -- render scenes/spheres.toml -o docs/pictures/spheres.png --spp 1024
	cargo run --release -- render scenes/weekend.toml -o docs/pictures/weekend.png --spp 512 -r 800x450
	cargo run --release -- render scenes/cornell.toml -o docs/pictures/cornell.png --spp 1024
	cargo run --release -- render scenes/sky.toml -o docs/pictures/sky.png --spp 192
	cargo run --release -- render scenes/lights.toml -o docs/pictures/lights.png --spp 512
	cargo run --release -- render scenes/roughness.toml -o docs/pictures/roughness.png --spp 512 -r 800x300
	cargo run --release -- render scenes/two-spheres.toml -o docs/pictures/two-spheres.png --spp 1024
	cargo run --release -- render scenes/locomotive.glb -o docs/pictures/locomotive.jpg --spp 256

# The pictures of the gallery (docs/gallery): less than half an hour on two cores.
.PHONY: gallery meshes
gallery:
	cargo build --release --locked
	python3 scenes/gallery.py --eyebeam target/release/eyebeam

# Other people's models with no options, beside their authors' screenshots: a page in target/thumbnails, to be looked at.
.PHONY: thumbnails
EYEBEAM_CORPUS ?= ../shared/scenes
thumbnails:
	cargo build --release --locked
	python3 scenes/thumbnails.py $(EYEBEAM_CORPUS)/gltf --eyebeam target/release/eyebeam

# What scenes/generate.py writes: meshes, and scenes that are long lists.
meshes:
	python3 scenes/generate.py

# The schema that editors use; a test checks that it is up to date.
schema:
	cargo run --release -- schema > docs/formats/scene.schema.json
