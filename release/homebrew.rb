# A recipe of Homebrew, completed at a release: the address and the checksum of the tag's archive.
class Affinor < Formula
  desc "Geometry and mechanics on Lie groups, exactly, symbolically or in floats"
  homepage "https://example.org/affinor"
  url "https://example.org/affinor/archive/refs/tags/v0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license any_of: ["MIT", "Apache-2.0"]

  depends_on "rust" => :build

  def install
    system "cargo", "install", *std_cargo_args(path: "cli")
    system "cargo", "run", "-p", "affinor-cli", "--example", "manual", "--", buildpath/"manual"
    man1.install Dir["manual/man1/*"]
    generate_completions_from_executable(bin/"affinor", "completions")
  end

  test do
    assert_match "Ric_11 = Ric_22 = Ric_33 = 1/2", shell_output("#{bin}/affinor table so3@zero --show ricci")
  end
end
